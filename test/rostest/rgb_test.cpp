// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "box_room.hpp"
#include "robot_transforms.hpp"
#include "ros_graph.hpp"
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Float32.h>

namespace cmn {
namespace {

const std::string kShippedModel = CMN_SOURCE_DIR "/models/wedge.pt";

/// A perception node that predicts from images.
class RgbTest : public testing::Test {
 protected:
  void launch(const std::string& model, const std::string& accumulate = "none") {
    node_ = std::make_unique<NodeProcess>(
        "perception",
        std::vector<std::string>{"_perception/source:=rgb", "_perception/rgb/model:=" + model,
                                 "_perception/accumulate:=" + accumulate,
                                 "_perception/guard/type:=footprint"});
  }
  void start(const std::string& accumulate) {
#ifdef CMN_LEARNING_ABSENT
    GTEST_SKIP() << "built without LibTorch";
#endif
    launch(kShippedModel, accumulate);
    ASSERT_TRUE(wait_for([this] {
      return images_.getNumSubscribers() > 0 && infos_.getNumSubscribers() > 0 &&
             scans_.getNumSubscribers() > 0 && local_.is_connected() && clear_.is_connected() &&
             diagnostics_.is_connected();
    })) << node_->output();
  }
  void TearDown() override {
    node_.reset();
    ros::param::del("/perception");
  }
  void expect_exit(const std::string& why) {
    ASSERT_TRUE(wait_for([this] { return !node_->is_running(); })) << node_->output();
    EXPECT_EQ(node_->exit_status(), 1);
    EXPECT_NE(node_->output().find(why), std::string::npos) << node_->output();
    EXPECT_FALSE(local_.is_connected()) << "nothing is advertised";
  }

  void send_scan(const ros::Time& stamp) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = stamp;
    scan.header.frame_id = "laser";
    scan.angle_min = static_cast<float>(-kPi);
    scan.angle_increment = static_cast<float>(2.0 * kPi / 360.0);
    scan.range_max = 8.0F;
    scan.ranges.assign(360, 2.0F);
    scans_.publish(scan);
  }
  static sensor_msgs::CameraInfo info_of(const CameraModel& camera) {
    sensor_msgs::CameraInfo info;
    info.width = static_cast<std::uint32_t>(camera.width);
    info.height = static_cast<std::uint32_t>(camera.height);
    info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
    return info;
  }
  /// A grey wall over a brown floor.
  static sensor_msgs::Image image_of(const CameraModel& camera, const std::string& encoding) {
    cv::Mat picture(camera.height, camera.width, CV_8UC3, cv::Scalar{60, 90, 120});
    picture.rowRange(0, camera.height / 2).setTo(cv::Scalar{200, 200, 200});
    const cv_bridge::CvImageConstPtr bgr{new cv_bridge::CvImage{{}, "bgr8", picture}};
    sensor_msgs::Image message = *cv_bridge::cvtColor(bgr, encoding)->toImageMsg();
    message.header.frame_id = "camera";
    return message;
  }

  /// Sends images of one pose until one of them is answered by a look that holds `is_it`.
  template <class Predicate>
  void look_until(const CameraModel& camera, const std::string& encoding, const Pose2& pose,
                  Predicate&& is_it) {
    local_.clear();
    sensor_msgs::Image image = image_of(camera, encoding);
    ASSERT_TRUE(wait_for([&] {
      infos_.publish(info_of(camera));
      image.header.stamp = ros::Time::now();
      transforms_.send_odometry(image.header.stamp, pose);
      send_scan(image.header.stamp);
      wait_for([] { return false; }, 0.02);  // sensors have a rate
      images_.publish(image);
      wait_for([&] { return !local_.empty(); }, 0.05);
      if (local_.empty()) {
        return false;
      }
      fastest_s_ = std::min(fastest_s_, (ros::Time::now() - local_.back().header.stamp).toSec());
      return is_it(local_.back());
    })) << node_->output();
  }
  template <class Spoil>
  void expect_drop(const std::string& reason, Spoil&& spoil) {
    SCOPED_TRACE(reason);
    const auto count = [&] {
      return diagnosed(diagnostics_, "perception: image", "dropped: " + reason);
    };
    const double before = count();
    EXPECT_TRUE(wait_for([&] {
      sensor_msgs::Image image = image_of(kCamera, "bgr8");
      image.header.stamp = ros::Time::now();
      spoil(image);
      transforms_.send_odometry(image.header.stamp, {});
      images_.publish(image);
      return wait_for([&] { return count() > before; }, 0.3);
    })) << node_->output();
  }

  double fastest_s_ = 1e9;  ///< from an image to what is predicted of it
  const CameraModel kCamera = CameraModel::from_field_of_view(160, 120, 1.2);
  ros::NodeHandle nh_;
  ros::Publisher images_ = nh_.advertise<sensor_msgs::Image>("image", 10);
  ros::Publisher infos_ = nh_.advertise<sensor_msgs::CameraInfo>("image/camera_info", 10);
  ros::Publisher scans_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
  RobotTransforms transforms_;
  Inbox<coarse_map_nav::LocalOccupancy> local_{"local_occupancy"};
  Inbox<std_msgs::Float32> clear_{"clear_ahead"};
  Inbox<sensor_msgs::Image> panoramas_{"panorama"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  std::unique_ptr<NodeProcess> node_;
};

#ifdef CMN_LEARNING_ABSENT
TEST_F(RgbTest, WithoutLibTorchItSaysWhatToInstall) {
  launch(kShippedModel);
  expect_exit("libtorch-dev");
}
#else
TEST_F(RgbTest, AModelThatIsNotThereEndsTheNode) {
  launch("/nowhere/model.pt");
  expect_exit("perception/rgb/model: /nowhere/model.pt: there is no such file");
}

TEST_F(RgbTest, AFileThatIsNoModelEndsTheNode) {
  launch(CMN_SOURCE_DIR "/package.xml");
  expect_exit("package.xml: is no TorchScript file, or is damaged");
}
#endif

TEST_F(RgbTest, BadInputIsDroppedAndCountedAndTheNextGoodOneIsUsed) {
  ASSERT_NO_FATAL_FAILURE(start("none"));
  if (IsSkipped()) {
    return;
  }
  transforms_.mount_sensors(camera_mount(0.05, 0.4, 0.1));
  const auto as_it_is = [](sensor_msgs::Image& /*image*/) {};
  expect_drop("the image has no image/camera_info yet", as_it_is);
  sensor_msgs::CameraInfo info = info_of(kCamera);
  info.width = 80;
  infos_.publish(info);
  expect_drop("the image is of another size than image/camera_info", as_it_is);
  infos_.publish(info_of(kCamera));
  expect_drop("the image is \"32FC1\", which is no colour, or cut short",
              [](sensor_msgs::Image& image) { image.encoding = "32FC1"; });
  expect_drop("the image is \"bgr8\", which is no colour, or cut short",
              [](sensor_msgs::Image& image) { image.data.resize(100); });
  expect_drop("no scan of about the same time", as_it_is);
  EXPECT_TRUE(local_.empty());
  look_until(kCamera, "bgr8", {}, [](const auto& /*local*/) { return true; });
  EXPECT_EQ(local_.back().source, coarse_map_nav::LocalOccupancy::SOURCE_RGB);
  EXPECT_NEAR(local_.back().clear_ahead, 2.0 - 0.17, 0.05) << "the LiDAR's word";
}

TEST_F(RgbTest, AnyEncodingAndSizeIsLookedAt) {
  ASSERT_NO_FATAL_FAILURE(start("none"));
  if (IsSkipped()) {
    return;
  }
  transforms_.mount_sensors(camera_mount(0.05, 0.4, 0.1));
  for (const char* encoding : {"bgr8", "rgb8", "rgba8", "bgra8", "mono8", "mono16"}) {
    SCOPED_TRACE(encoding);
    look_until(CameraModel::from_field_of_view(640, 480, 1.2), encoding, {},
               [](const auto& /*local*/) { return true; });
    look_until(CameraModel::from_field_of_view(79, 61, 2.0), encoding, {},
               [](const auto& /*local*/) { return true; });
  }
  // The image is sent 0.02 s after its stamp, a prediction takes 0.01 s; the fastest of a dozen.
  EXPECT_LT(fastest_s_, 0.5);
  for (const auto& local : local_.all()) {
    EXPECT_EQ(local->size, static_cast<std::uint32_t>(kNearSize));
    for (std::size_t i = 0; i < local->occupancy.size(); ++i) {
      ASSERT_TRUE(local->occupancy[i] >= 0.0F && local->occupancy[i] <= 1.0F);
      ASSERT_TRUE(local->confidence[i] >= 0.0F && local->confidence[i] <= 1.0F);
    }
  }
}

TEST_F(RgbTest, APanoramaIsPredictedFromOnceTheRobotHasTurnedRound) {
  ASSERT_NO_FATAL_FAILURE(start("panorama"));
  if (IsSkipped()) {
    return;
  }
  transforms_.mount_sensors(camera_mount(0.05, 0.4, 0.1));
  const auto seen_share = [](const coarse_map_nav::LocalOccupancy& local) {
    return static_cast<double>(std::count_if(local.confidence.begin(), local.confidence.end(),
                                             [](float c) { return c > 0.0F; })) /
           static_cast<double>(local.confidence.size());
  };
  for (int turn = 0; turn < 4; ++turn) {
    SCOPED_TRACE(turn);
    look_until(kCamera, "bgr8", {0.0, 0.0, turn * kPi / 2.0},
               [](const auto& local) { return local.partial != 0; });
    EXPECT_EQ(seen_share(local_.back()), 0.0);
  }
  look_until(kCamera, "bgr8", {0.0, 0.0, 2.0 * kPi},
             [](const auto& local) { return local.partial == 0; });
  EXPECT_GT(seen_share(local_.back()), 0.1);
  ASSERT_TRUE(wait_for([this] { return !panoramas_.empty(); })) << node_->output();
  EXPECT_EQ(panoramas_.back().width, 4U * 160U);
}

}  // namespace
}  // namespace cmn
