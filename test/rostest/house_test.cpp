// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The nodes in a furnished house: cameras, local occupancy of a depth camera, panoramas.
#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/ros/camera_conversions.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include "ros_graph.hpp"
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Float32.h>

namespace cmn {
namespace {

const std::string kHouse = "house:2";
const std::string kBase = "_frames/base:=base_footprint";
using coarse_map_nav::DiscreteAction;

TEST(SceneWorlds, ThatCannotBeEndTheSimulatorWithASentence) {
  const std::string hollow =
      file_with("hollow.world", "<sdf version='1.6'><world name='w'></world></sdf>");
  const std::string broken = file_with("broken.sdf", "<sdf version='1.6'><world name='w'>");
  struct Case {
    std::string world;
    std::string says;
  };
  const std::vector<Case> cases{{"/nowhere/room.world", "/nowhere/room.world: no such file"},
                                {hollow, hollow + ": nothing in it has a surface"},
                                {broken, broken + ": "},
                                {"house:", "house:: a house has a number"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.world);
    NodeProcess node{"simulator", {"_world:=" + c.world, kBase}};
    ASSERT_TRUE(wait_for([&] { return !node.is_running(); })) << "it runs: " << node.output();
    EXPECT_EQ(node.exit_status(), 1) << node.output();
    EXPECT_NE(node.output().find(c.says), std::string::npos) << node.output();
    ros::param::del("/simulator");
  }
}

/// In a furnished house.
class CameraTest : public testing::Test {
 protected:
  template <class Message>
  void expect_frame(const Inbox<Message>& inbox, const std::string& frame) {
    ASSERT_FALSE(inbox.empty()) << node_.output();
    EXPECT_EQ(inbox.back().header.frame_id, frame);
  }

  Inbox<rosgraph_msgs::Clock> clocks_{"/clock"};
  NodeProcess node_{"simulator", {"_world:=" + kHouse, kBase, "_speed:=5.0", "_seed:=3"}};
};

TEST_F(CameraTest, NothingIsMadeThatNobodyListensTo) {
  ASSERT_TRUE(wait_for([this] { return !clocks_.empty() && clocks_.back().clock.toSec() > 3.0; }))
      << node_.output();
  Inbox<sensor_msgs::Image> depths{"depth/image"};
  ASSERT_TRUE(wait_for([&] { return depths.size() >= 3; })) << node_.output();
  EXPECT_EQ(depths.all().front()->header.seq, 0U) << "none was sent before";
  EXPECT_GT(depths.all().front()->header.stamp, ros::Time{2.5});
}

TEST_F(CameraTest, ImageCloudAndColourAreOfOneMoment) {
  Inbox<sensor_msgs::Image> depths{"depth/image"};
  Inbox<sensor_msgs::CameraInfo> infos{"camera_info"};
  Inbox<sensor_msgs::PointCloud2> clouds{"points"};
  Inbox<sensor_msgs::Image> images{"image"};
  Inbox<sensor_msgs::CameraInfo> image_infos{"image/camera_info"};
  const auto at = [](const auto& inbox, const ros::Time& stamp) {
    const auto found = std::find_if(inbox.all().begin(), inbox.all().end(),
                                    [&](const auto& m) { return m->header.stamp == stamp; });
    return found == inbox.all().end() ? nullptr : found->get();
  };
  const sensor_msgs::Image* image = nullptr;
  ASSERT_TRUE(wait_for([&] {
    for (const auto& cloud : clouds.all()) {
      const ros::Time stamp = cloud->header.stamp;
      if (at(depths, stamp) != nullptr && at(infos, stamp) != nullptr &&
          at(images, stamp) != nullptr && at(image_infos, stamp) != nullptr) {
        image = at(depths, stamp);
        return true;
      }
    }
    return false;
  })) << node_.output();
  expect_frame(depths, "camera_depth_optical_frame");
  expect_frame(infos, "camera_depth_optical_frame");
  expect_frame(clouds, "camera_depth_optical_frame");
  expect_frame(images, "camera_color_optical_frame");
  EXPECT_EQ(images.back().encoding, "bgr8");
  EXPECT_EQ(images.back().width, image_infos.back().width);
  std::string why;
  const auto camera = camera_of(infos.back(), why);
  ASSERT_TRUE(camera) << why;
  const auto depth = depth_of(*image, *camera, Eigen::Isometry3d::Identity(), why);
  ASSERT_TRUE(depth) << why;
  const auto cloud = view_of(*at(clouds, image->header.stamp), Eigen::Isometry3d::Identity(), why);
  ASSERT_TRUE(cloud) << why;
  int readings = 0;
  for (std::size_t i = 0; i < depth->depth_m.total(); ++i) {
    const float z = depth->depth_m.ptr<float>()[i];
    readings += z > 0.0F;
    const float of_cloud = coordinate_of(cloud->data + i * cloud->point_step, cloud->z);
    ASSERT_TRUE(std::isnan(z) ? std::isnan(of_cloud) : of_cloud == z);
  }
  EXPECT_GT(readings, static_cast<int>(depth->depth_m.total()) / 4);
}

/// A robot in the house whose perception sees by its depth camera. The test hands the images on.
class DepthInAHouse : public testing::Test {
 protected:
  void start(const std::string& accumulate, const std::string& infos = "camera_info") {
    simulator_ = std::make_unique<NodeProcess>(
        "simulator",
        std::vector<std::string>{"_world:=" + kHouse, kBase, "_speed:=4.0", "_seed:=3"});
    perception_ = std::make_unique<NodeProcess>(
        "perception",
        std::vector<std::string>{
            "depth/image:=handed_on", "points:=nowhere", "camera_info:=" + infos, kBase,
            "_perception/source:=depth", "_perception/accumulate:=" + accumulate,
            "_perception/local_occupancy/side_m:=8.0", "_perception/local_occupancy/size:=80",
            "_perception/guard/type:=footprint"});
    motion_ = std::make_unique<NodeProcess>("motion_controller", std::vector<std::string>{kBase});
  }
  void TearDown() override {
    for (const char* node : {"/simulator", "/perception", "/motion_controller"}) {
      ros::param::del(node);
    }
  }
  std::string output() const { return simulator_->output() + perception_->output(); }

  double now_s() const { return clocks_.empty() ? 0.0 : clocks_.back().clock.toSec(); }
  /// Handles messages for so long as the robots' clock tells.
  void pass(double time_s) {
    const double until_s = now_s() + time_s;
    ASSERT_TRUE(wait_for([&] { return now_s() >= until_s; })) << output();
  }
  int level() const {
    for (auto message = diagnostics_.all().rbegin(); message != diagnostics_.all().rend();
         ++message) {
      for (const auto& status : (*message)->status) {
        if (status.name == "perception: depth") {
          return status.level;
        }
      }
    }
    return -1;
  }

  /// Asks for an action until it is answered, as the planner does: a motion controller that has
  /// just started may have no odometry yet.
  void act(DiscreteAction action) {
    double asked_s = -1.0;
    ASSERT_TRUE(wait_for([&] {
      if (now_s() >= asked_s + 1.0) {
        asked_s = now_s();
        action.header.stamp = ros::Time{asked_s};
        actions_.publish(action);
      }
      return !results_.empty() && results_.back().id == action.id;
    })) << motion_->output();
  }
  /// Has the robot turn by a quarter to the left; the newest look is at rest after it.
  void turn_left(std::uint32_t id) {
    DiscreteAction action;
    action.id = id;
    action.type = DiscreteAction::TURN_LEFT;
    ASSERT_NO_FATAL_FAILURE(act(action));
    EXPECT_EQ(results_.back().outcome, coarse_map_nav::MotionResult::SUCCEEDED);
    ASSERT_TRUE(wait_for([&] {
      return !looks_.empty() && looks_.back().header.stamp > results_.back().header.stamp;
    })) << output();
  }

  ros::NodeHandle nh_;
  bool is_handing_on_ = true;
  ros::Publisher handed_on_ = nh_.advertise<sensor_msgs::Image>("handed_on", 5);
  ros::Subscriber images_ = nh_.subscribe<sensor_msgs::Image>(
      "depth/image", 5, [this](const sensor_msgs::Image::ConstPtr& image) {
        if (is_handing_on_) {
          handed_on_.publish(image);
        }
      });
  ros::Publisher actions_ = nh_.advertise<DiscreteAction>("action", 1);
  Inbox<rosgraph_msgs::Clock> clocks_{"/clock"};
  Inbox<coarse_map_nav::LocalOccupancy> looks_{"local_occupancy"};
  Inbox<coarse_map_nav::MotionResult> results_{"motion_result"};
  Inbox<std_msgs::Float32> clear_{"clear_ahead"};
  Inbox<nav_msgs::Odometry> truths_{"ground_truth"};
  Inbox<sensor_msgs::Image> panoramas_{"panorama"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  std::unique_ptr<NodeProcess> simulator_;
  std::unique_ptr<NodeProcess> perception_;
  std::unique_ptr<NodeProcess> motion_;
};

TEST_F(DepthInAHouse, WithoutCameraInfoNothingIsSeenAndNobodyMayDrive) {
  start("none", "nowhere_info");
  ASSERT_TRUE(wait_for([this] {
    return diagnosed(diagnostics_, "perception: depth",
                     "dropped: the depth image has no camera_info yet") >= 3.0;
  })) << output();
  EXPECT_TRUE(looks_.empty());
  EXPECT_TRUE(clear_.empty());
  DiscreteAction action;
  action.id = 1;
  action.type = DiscreteAction::MOVE_FORWARD;
  action.distance = 0.15F;
  ASSERT_NO_FATAL_FAILURE(act(action));
  EXPECT_NE(results_.back().outcome, coarse_map_nav::MotionResult::SUCCEEDED);
  EXPECT_NEAR(results_.back().displacement.x, 0.0, 0.01);
}

TEST_F(DepthInAHouse, ACameraThatStopsIsReportedAndTakenUpAgain) {
  start("rolling");
  ASSERT_TRUE(wait_for([this] { return looks_.size() >= 3; })) << output();
  is_handing_on_ = false;
  ASSERT_TRUE(wait_for([this] { return level() == diagnostic_msgs::DiagnosticStatus::ERROR; }))
      << output();
  looks_.clear();
  clear_.clear();
  ASSERT_NO_FATAL_FAILURE(pass(1.0));
  EXPECT_TRUE(looks_.empty());
  EXPECT_TRUE(clear_.empty()) << "nobody knows what is ahead";
  is_handing_on_ = true;
  ASSERT_TRUE(wait_for([this] { return !looks_.empty() && !clear_.empty(); })) << output();
  ASSERT_TRUE(wait_for([this] { return level() == diagnostic_msgs::DiagnosticStatus::OK; }));
}

TEST_F(DepthInAHouse, APanoramaOfFourLooksShowsTheHouse) {
  start("panorama");
  ASSERT_TRUE(wait_for([this] { return looks_.size() >= 2 && !truths_.empty(); })) << output();
  for (std::uint32_t turn = 1; turn <= 4; ++turn) {
    EXPECT_EQ(looks_.back().partial, 1) << "turn " << turn;
    ASSERT_NO_FATAL_FAILURE(turn_left(turn));
  }
  ASSERT_TRUE(wait_for([this] { return looks_.back().partial == 0; })) << output();
  ASSERT_TRUE(wait_for([this] { return !panoramas_.empty(); })) << output();
  EXPECT_EQ(panoramas_.back().width, 4 * panoramas_.back().height) << "four square colour images";

  std::string why;
  const auto seen = local_occupancy_of(looks_.back(), why);
  ASSERT_TRUE(seen) << why;
  const World house{open_scene_world(kHouse).body};
  const Pose2 T_world_robot = *pose_of(truths_.back().pose.pose);
  int cells = 0;
  int right = 0;
  for (std::size_t i = 0; i < seen->cell_count(); ++i) {
    const int ix = static_cast<int>(i) % seen->size;
    const int iy = static_cast<int>(i) / seen->size;
    const Point2 p = T_world_robot * Point2{(ix + 0.5 - 0.5 * seen->size) * seen->resolution,
                                            (iy + 0.5 - 0.5 * seen->size) * seen->resolution};
    if (seen->confidence[i] == 1.0F) {
      ++cells;
      // Free ground is free; within a cell and a half of what is occupied something stands.
      right += seen->occupancy[i] < 0.5F ? house.is_disc_free(p, 0.01)
                                         : !house.is_disc_free(p, 1.5 * seen->resolution);
    }
  }
  EXPECT_GT(cells, 300);
  EXPECT_GT(right, 0.95 * cells) << right << " of " << cells;
}

}  // namespace
}  // namespace cmn
