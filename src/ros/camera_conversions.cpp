// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/camera_conversions.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>

namespace cmn {
namespace {

/// More is no image of a depth camera, and sizes below it cannot overflow.
constexpr std::uint32_t kMostPixels = 1U << 14U;  ///< a side

/// A coordinate of the cloud; empty, and `why` says so, when it has none that fits into a point.
std::optional<PointField> field_of(const sensor_msgs::PointCloud2& cloud, const std::string& name,
                                   std::string& why) {
  using Field = sensor_msgs::PointField;
  for (const Field& field : cloud.fields) {
    if (field.name != name) {
      continue;
    }
    const bool is_double = field.datatype == Field::FLOAT64;
    const std::size_t size = is_double ? sizeof(double) : sizeof(float);
    if (!is_double && field.datatype != Field::FLOAT32) {
      why = "the cloud's " + name + " is neither float32 nor float64";
    } else if (field.count > 1 || std::size_t{field.offset} + size > cloud.point_step) {
      why = "the cloud's " + name + " does not fit into a point";
    } else {
      return PointField{field.offset, is_double};
    }
    return std::nullopt;
  }
  why = "the cloud has no field " + name;
  return std::nullopt;
}

}  // namespace

std::optional<Eigen::Isometry3d> isometry_of(const geometry_msgs::Transform& transform) {
  const auto& p = transform.translation;
  const auto& q = transform.rotation;
  const Eigen::Quaterniond rotation{q.w, q.x, q.y, q.z};
  const double norm = rotation.norm();
  if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(norm) || norm < 1e-6) {
    return std::nullopt;
  }
  return Eigen::Translation3d{p.x, p.y, p.z} * rotation.normalized();
}

std::optional<PointCloudView> view_of(const sensor_msgs::PointCloud2& cloud,
                                      const Eigen::Isometry3d& T_robot_camera, std::string& why) {
  PointCloudView view;
  view.stamp_s = cloud.header.stamp.toSec();
  view.data = cloud.data.data();
  view.width = cloud.width;
  view.height = cloud.height;
  view.point_step = cloud.point_step;
  view.row_step = cloud.row_step;
  view.T_robot_camera = T_robot_camera;
  const std::array<std::pair<const char*, PointField*>, 3> coordinates{
      {{"x", &view.x}, {"y", &view.y}, {"z", &view.z}}};
  for (const auto& [name, field] : coordinates) {
    const std::optional<PointField> found = field_of(cloud, name, why);
    if (!found) {
      return std::nullopt;
    }
    *field = *found;
  }
  // Divisions, since the products of the message's numbers may overflow.
  const bool has_rows = view.width == 0 || view.row_step / view.width >= view.point_step;
  if (cloud.is_bigendian != 0) {
    why = "the cloud is big-endian";
  } else if (view.width == 0 || view.height == 0) {
    why = "the cloud has no points";
  } else if (view.height > 1 ? !has_rows || view.data == nullptr ||
                                   cloud.data.size() / view.height < view.row_step
                             : cloud.data.size() / view.width < view.point_step) {
    why = "the cloud has fewer bytes than points";
  } else {
    return view;
  }
  return std::nullopt;
}

std::optional<CameraModel> camera_of(const sensor_msgs::CameraInfo& info, std::string& why) {
  const bool has_size =
      info.width > 0 && info.height > 0 && info.width <= kMostPixels && info.height <= kMostPixels;
  const CameraModel camera{static_cast<int>(info.width),
                           static_cast<int>(info.height),
                           info.K[0],
                           info.K[4],
                           info.K[2],
                           info.K[5]};
  // Less than a degree or more than 179 in view is no camera of a robot.
  const auto is_focal_length = [&](double f, std::uint32_t side) {
    return f > 0.004 * side && f < 60.0 * side;
  };
  if (!has_size || !is_focal_length(camera.fx, info.width) ||
      !is_focal_length(camera.fy, info.height) || !(std::abs(camera.cx) < 10.0 * info.width) ||
      !(std::abs(camera.cy) < 10.0 * info.height)) {
    why = "camera_info is of no camera: it is not calibrated";
    return std::nullopt;
  }
  return camera;
}

std::optional<DepthImage> depth_of(const sensor_msgs::Image& image, const CameraModel& camera,
                                   const Eigen::Isometry3d& T_robot_camera, std::string& why) {
  namespace encodings = sensor_msgs::image_encodings;
  const bool is_mm = image.encoding == encodings::TYPE_16UC1 || image.encoding == encodings::MONO16;
  const std::size_t row_bytes = std::size_t{image.width} * (is_mm ? 2 : 4);
  if (!is_mm && image.encoding != encodings::TYPE_32FC1) {
    why = "the depth image is \"" + image.encoding.substr(0, 20) + "\", neither 16UC1 nor 32FC1";
  } else if (image.is_bigendian != 0) {
    why = "the depth image is big-endian";
  } else if (image.width != static_cast<std::uint32_t>(camera.width) ||
             image.height != static_cast<std::uint32_t>(camera.height)) {
    why = "the depth image is of another size than camera_info";
  } else if (image.step < row_bytes || image.data.size() / image.height < image.step) {
    why = "the depth image has fewer bytes than pixels";
  } else {
    DepthImage depth;
    depth.stamp_s = image.header.stamp.toSec();
    depth.camera = camera;
    depth.T_robot_camera = T_robot_camera;
    // Row by row: a step that is no whole number of pixels is odd, but well.
    cv::Mat pixels(camera.height, camera.width, is_mm ? CV_16UC1 : CV_32FC1);
    for (int v = 0; v < camera.height; ++v) {
      std::memcpy(pixels.ptr(v), image.data.data() + static_cast<std::size_t>(v) * image.step,
                  row_bytes);
    }
    pixels.convertTo(depth.depth_m, CV_32FC1, is_mm ? 0.001 : 1.0);
    return depth;
  }
  return std::nullopt;
}

std::optional<ColorImage> color_of(const sensor_msgs::Image& image, const CameraModel& camera,
                                   const Eigen::Isometry3d& T_robot_camera, std::string& why) {
  if (image.width != static_cast<std::uint32_t>(camera.width) ||
      image.height != static_cast<std::uint32_t>(camera.height)) {
    why = "the image is of another size than image/camera_info";
    return std::nullopt;
  }
  try {
    const cv_bridge::CvImagePtr copy =
        cv_bridge::toCvCopy(image, sensor_msgs::image_encodings::BGR8);
    return ColorImage{image.header.stamp.toSec(), camera, T_robot_camera, copy->image};
  } catch (const std::exception&) {  // cv_bridge's own, and OpenCV's of odd sizes
    why = "the image is \"" + image.encoding.substr(0, 20) + "\", which is no colour, or cut short";
  }
  return std::nullopt;
}

sensor_msgs::CameraInfo message_of(const CameraModel& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

sensor_msgs::Image message_of(const DepthImage& depth, const std_msgs::Header& header) {
  return *cv_bridge::CvImage{header, sensor_msgs::image_encodings::TYPE_32FC1, depth.depth_m}
              .toImageMsg();
}

sensor_msgs::PointCloud2 cloud_of(const DepthImage& depth, const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  sensor_msgs::PointCloud2Modifier{cloud}.setPointCloud2FieldsByString(1, "xyz");
  cloud.width = static_cast<std::uint32_t>(depth.camera.width);
  cloud.height = static_cast<std::uint32_t>(depth.camera.height);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(std::size_t{cloud.row_step} * cloud.height);
  cloud.is_dense = 0;
  sensor_msgs::PointCloud2Iterator<float> point{cloud, "x"};
  for (int v = 0; v < depth.camera.height; ++v) {
    for (int u = 0; u < depth.camera.width; ++u, ++point) {
      const float z = depth.depth_m.at<float>(v, u);
      point[0] = static_cast<float>((u - depth.camera.cx) / depth.camera.fx) * z;
      point[1] = static_cast<float>((v - depth.camera.cy) / depth.camera.fy) * z;
      point[2] = z;
    }
  }
  return cloud;
}

}  // namespace cmn
