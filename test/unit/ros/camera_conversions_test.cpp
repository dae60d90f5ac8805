// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/camera_conversions.hpp"

#include "coarse_map_nav/ros/panorama_strip.hpp"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

using Field = sensor_msgs::PointField;
const Eigen::Isometry3d kMount = Eigen::Isometry3d::Identity();

template <class Message>
struct Fault {
  std::string reason;
  std::function<void(Message&)> spoil;
};

Field field(const std::string& name, std::uint32_t offset, std::uint8_t type) {
  Field f;
  f.name = name;
  f.offset = offset;
  f.datatype = type;
  f.count = 1;
  return f;
}

/// 3 x 2 points with padding, in the order z, intensity, x (double), y.
sensor_msgs::PointCloud2 mixed_cloud() {
  sensor_msgs::PointCloud2 cloud;
  cloud.width = 3;
  cloud.height = 2;
  cloud.point_step = 24;
  cloud.row_step = 80;
  cloud.fields = {field("z", 0, Field::FLOAT32), field("intensity", 4, Field::UINT8),
                  field("x", 8, Field::FLOAT64), field("y", 16, Field::FLOAT32)};
  cloud.data.assign(160, 0xff);
  for (std::uint32_t v = 0; v < 2; ++v) {
    for (std::uint32_t u = 0; u < 3; ++u) {
      std::uint8_t* point = cloud.data.data() + v * 80 + u * 24;
      const float y = static_cast<float>(v), z = 0.5F;
      const double x = u;
      std::memcpy(point, &z, 4);
      std::memcpy(point + 8, &x, 8);
      std::memcpy(point + 16, &y, 4);
    }
  }
  return cloud;
}

TEST(CloudConversion, AnyOrderOfFieldsWithPaddingIsRead) {
  std::string why;
  const sensor_msgs::PointCloud2 cloud = mixed_cloud();
  const auto view = view_of(cloud, kMount, why);
  ASSERT_TRUE(view) << why;
  const std::uint8_t* point = view->data + 1 * view->row_step + 2 * view->point_step;
  EXPECT_EQ(coordinate_of(point, view->x), 2.0F);
  EXPECT_EQ(coordinate_of(point, view->y), 1.0F);
  EXPECT_EQ(coordinate_of(point, view->z), 0.5F);
}

TEST(CloudConversion, WhatIsNoCloudOfPointsIsRefusedWithAReason) {
  using Cloud = sensor_msgs::PointCloud2;
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Fault<Cloud>> faults{
      {"the cloud has no field x", [](Cloud& c) { c.fields.clear(); }},
      {"the cloud has no field y", [](Cloud& c) { c.fields[3].name = "why"; }},
      {"the cloud's z is neither float32 nor float64",
       [](Cloud& c) { c.fields[0].datatype = Field::INT16; }},
      {"the cloud's x does not fit into a point", [](Cloud& c) { c.fields[2].offset = 17; }},
      {"the cloud's x does not fit into a point", [](Cloud& c) { c.fields[2].offset = kMost; }},
      {"the cloud's z does not fit into a point", [](Cloud& c) { c.fields[0].count = 3; }},
      {"the cloud is big-endian", [](Cloud& c) { c.is_bigendian = 1; }},
      {"the cloud has no points", [](Cloud& c) { c.width = 0; }},
      {"the cloud has no points", [](Cloud& c) { c.height = 0; }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.data.pop_back(); }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.data.clear(); }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.row_step = 71; }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.row_step = kMost; }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.width = kMost; }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.height = kMost; }},
      {"the cloud has fewer bytes than points", [](Cloud& c) { c.point_step = kMost; }},
  };
  for (const auto& fault : faults) {
    SCOPED_TRACE(fault.reason);
    sensor_msgs::PointCloud2 cloud = mixed_cloud();
    fault.spoil(cloud);
    std::string why;
    EXPECT_FALSE(view_of(cloud, kMount, why));
    EXPECT_EQ(why, fault.reason);
  }
}

sensor_msgs::CameraInfo camera_info() {
  sensor_msgs::CameraInfo info;
  info.width = 4;
  info.height = 2;
  info.K = {3.0, 0.0, 1.5, 0.0, 3.0, 0.5, 0.0, 0.0, 1.0};
  return info;
}

sensor_msgs::Image image_of(const std::string& encoding, std::uint32_t step) {
  sensor_msgs::Image image;
  image.width = 4;
  image.height = 2;
  image.encoding = encoding;
  image.step = step;
  image.data.assign(2 * step, 0);
  return image;
}

TEST(DepthConversion, MillimetresAndMetresBecomeMetres) {
  std::string why;
  const auto camera = camera_of(camera_info(), why);
  ASSERT_TRUE(camera) << why;
  EXPECT_EQ(camera->cx, 1.5);
  sensor_msgs::Image mm = image_of("16UC1", 11);  // padding that is no whole pixel
  const std::uint16_t depth_mm = 1234;
  std::memcpy(mm.data.data() + 11 + 2, &depth_mm, 2);
  const auto of_mm = depth_of(mm, *camera, kMount, why);
  ASSERT_TRUE(of_mm) << why;
  EXPECT_NEAR(of_mm->depth_m.at<float>(1, 1), 1.234, 1e-6);
  EXPECT_EQ(of_mm->depth_m.at<float>(0, 0), 0.0F);
  sensor_msgs::Image m = image_of("32FC1", 16);
  const float depth_m = 2.5F;
  std::memcpy(m.data.data() + 16 + 4, &depth_m, 4);
  const auto of_m = depth_of(m, *camera, kMount, why);
  ASSERT_TRUE(of_m) << why;
  EXPECT_EQ(of_m->depth_m.at<float>(1, 1), 2.5F);
}

TEST(DepthConversion, OtherImagesAreRefusedWithAReason) {
  using Image = sensor_msgs::Image;
  const std::vector<Fault<Image>> faults{
      {"the depth image is \"rgb8\", neither 16UC1 nor 32FC1",
       [](Image& i) { i.encoding = "rgb8"; }},
      {"the depth image is big-endian", [](Image& i) { i.is_bigendian = 1; }},
      {"the depth image is of another size than camera_info", [](Image& i) { i.width = 5; }},
      {"the depth image is of another size than camera_info", [](Image& i) { i.height = 0; }},
      {"the depth image has fewer bytes than pixels", [](Image& i) { i.step = 15; }},
      {"the depth image has fewer bytes than pixels", [](Image& i) { i.data.pop_back(); }},
      {"the depth image has fewer bytes than pixels", [](Image& i) { i.step = ~0U; }},
  };
  std::string why;
  const auto camera = camera_of(camera_info(), why);
  for (const auto& fault : faults) {
    SCOPED_TRACE(fault.reason);
    sensor_msgs::Image image = image_of("32FC1", 16);
    fault.spoil(image);
    EXPECT_FALSE(depth_of(image, *camera, kMount, why));
    EXPECT_EQ(why, fault.reason);
  }
}

TEST(DepthConversion, AnUncalibratedCameraIsRefused) {
  using Info = sensor_msgs::CameraInfo;
  const double nan = std::nan("");
  for (const auto& spoil : std::vector<std::function<void(Info&)>>{
           [](Info& i) { i.K[0] = 0.0; }, [](Info& i) { i.K[4] = -3.0; },
           [nan](Info& i) { i.K[2] = nan; }, [](Info& i) { i.K[5] = 1e30; },
           [](Info& i) { i.width = 0; }, [](Info& i) { i.height = 1000000; }}) {
    sensor_msgs::CameraInfo info = camera_info();
    spoil(info);
    std::string why;
    EXPECT_FALSE(camera_of(info, why));
    EXPECT_EQ(why, "camera_info is of no camera: it is not calibrated");
  }
}

TEST(MountConversion, WhatIsNoPoseIsRefused) {
  geometry_msgs::Transform transform;
  EXPECT_FALSE(isometry_of(transform)) << "all zero, as in a message nobody filled in";
  transform.rotation.w = 2.0;
  transform.translation.z = 0.5;
  ASSERT_TRUE(isometry_of(transform));
  EXPECT_TRUE(isometry_of(transform)->linear().isIdentity(1e-12));
  transform.translation.x = std::nan("");
  EXPECT_FALSE(isometry_of(transform));
}

TEST(PanoramaStrip, ShowsLeftAheadRightAndBehindInTheOrderInWhichTheyAreSeen) {
  std::vector<std::pair<double, cv::Mat>> images;
  for (int quarter = 0; quarter < 4; ++quarter) {
    images.emplace_back(1.0 + quarter * M_PI / 2.0,
                        cv::Mat(2 + quarter, 2 + quarter, CV_8UC3, cv::Scalar::all(quarter)));
  }
  const cv::Mat strip = panorama_of(images, 1.0);
  ASSERT_EQ(strip.rows, 3) << "as the left one";
  ASSERT_EQ(strip.cols, 12);
  std::vector<int> order;
  for (const int column : {1, 4, 7, 10}) {
    order.push_back(strip.at<cv::Vec3b>(1, column)[0]);
  }
  EXPECT_EQ(order, (std::vector<int>{1, 0, 3, 2}));
  images.pop_back();
  EXPECT_TRUE(panorama_of(images, 1.0).empty());
}

/// 4 x 3 pixels, one of them a hole.
DepthImage small_depth() {
  DepthImage depth;
  depth.camera = CameraModel::from_field_of_view(4, 3, 1.2);
  depth.depth_m = (cv::Mat_<float>(3, 4) << 1, 2, 3, 4, 5, NAN, 7, 8, 9, 10, 11, 12);
  return depth;
}

TEST(CameraConversion, WhatASimulatedCameraSendsIsReadAsItWas) {
  const DepthImage depth = small_depth();
  std_msgs::Header header;
  header.stamp = ros::Time{3.5};
  header.frame_id = "eye";
  std::string why;
  const auto camera = camera_of(message_of(depth.camera, header), why);
  ASSERT_TRUE(camera) << why;
  EXPECT_EQ(camera->fx, depth.camera.fx);
  EXPECT_EQ(camera->cy, depth.camera.cy);
  const sensor_msgs::Image image = message_of(depth, header);
  EXPECT_EQ(image.header.frame_id, "eye");
  const auto read = depth_of(image, *camera, kMount, why);
  ASSERT_TRUE(read) << why;
  EXPECT_EQ(read->stamp_s, 3.5);
  for (int i = 0; i < 12; ++i) {
    const float z = depth.depth_m.ptr<float>()[i];
    EXPECT_TRUE(std::isnan(z) ? std::isnan(read->depth_m.ptr<float>()[i])
                              : read->depth_m.ptr<float>()[i] == z);
  }
}

TEST(CameraConversion, TheCloudOfADepthImageHasItsPixelsPoints) {
  const DepthImage depth = small_depth();
  const sensor_msgs::PointCloud2 cloud = cloud_of(depth, {});
  std::string why;
  const auto view = view_of(cloud, kMount, why);
  ASSERT_TRUE(view) << why;
  ASSERT_EQ(view->width, 4U);
  ASSERT_EQ(view->height, 3U);
  for (std::size_t v = 0; v < 3; ++v) {
    for (std::size_t u = 0; u < 4; ++u) {
      const std::uint8_t* point = view->data + v * view->row_step + u * view->point_step;
      const float z = depth.depth_m.at<float>(static_cast<int>(v), static_cast<int>(u));
      if (std::isnan(z)) {
        EXPECT_TRUE(std::isnan(coordinate_of(point, view->x)));
        continue;
      }
      EXPECT_EQ(coordinate_of(point, view->z), z);
      EXPECT_NEAR(coordinate_of(point, view->x),
                  (static_cast<double>(u) - depth.camera.cx) / depth.camera.fx * z, 1e-5);
      EXPECT_NEAR(coordinate_of(point, view->y),
                  (static_cast<double>(v) - depth.camera.cy) / depth.camera.fy * z, 1e-5);
    }
  }
}

}  // namespace
}  // namespace cmn
