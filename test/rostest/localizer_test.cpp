// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include "ros_graph.hpp"
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Empty.h>
#include <std_srvs/Empty.h>
#include <tf2_msgs/TFMessage.h>

namespace cmn {
namespace {

using PoseMessage = geometry_msgs::PoseWithCovarianceStamped;

const CoarseMap& drawing() {
  static const CoarseMap map = ascii_map({"############",  //
                                          "#..........#",  //
                                          "#.####.###.#",  //
                                          "#.#....#...#",  //
                                          "#..........#",  //
                                          "############"},
                                         0.4, {-1.0, 2.0, 0.0});
  return map;
}

/// A localizer; the test is clock, base, perception and map server.
class LocalizerTest : public testing::Test {
 protected:
  void SetUp() override {
    start_localizer();
    time_s_ = 100.0;
  }

  void start_localizer() {
    localizer_ = std::make_unique<NodeProcess>("localizer");
    ASSERT_TRUE(wait_for([this] {
      send_clock();
      return occupancies_.getNumSubscribers() > 0 && maps_.getNumSubscribers() > 0 &&
             results_.getNumSubscribers() > 0 && initial_poses_.getNumSubscribers() > 0 &&
             tf_.getNumSubscribers() > 0 && beliefs_.is_connected() && poses_.is_connected() &&
             transforms_.is_connected() && observes_.is_connected() && diagnostics_.is_connected();
    })) << localizer_->output();
  }

  void send_clock() {
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time{time_s_};
    clocks_.publish(clock);
  }
  void send_map() {
    nav_msgs::OccupancyGrid grid = grid_message(drawing());
    grid.header.frame_id = "map";
    maps_.publish(grid);
  }
  void send_odometry() {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time{time_s_};
    transform.header.frame_id = "odom";
    transform.child_frame_id = "base_link";
    transform.transform = transform_message(T_odom_robot_);
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    tf_.publish(message);
  }
  coarse_map_nav::LocalOccupancy observation() const {
    LocalOccupancy local{9, 0.14};
    for (std::size_t i = 0; i < local.cell_count(); ++i) {
      local.occupancy[i] = i < 27 ? 1.0F : 0.0F;  // a wall on the right
      local.confidence[i] = 1.0F;
    }
    std_msgs::Header header;
    header.stamp = ros::Time{time_s_};
    header.frame_id = "base_link";
    return message_of(local, header);
  }
  /// A tenth of a second passes; perception and base say what they see.
  void tick() {
    time_s_ += 0.1;
    send_clock();
    if (has_odometry_) {
      send_odometry();
    }
    occupancies_.publish(observation());
    wait_for([] { return false; }, 0.005);
  }
  template <class Predicate>
  bool tick_until(Predicate holds) {
    return wait_for([&] {
      if (holds()) {
        return true;
      }
      tick();
      return holds();
    });
  }
  void believe_anything() {
    send_map();
    ASSERT_TRUE(tick_until([this] { return !beliefs_.empty(); })) << localizer_->output();
  }
  void end_action(std::uint32_t id) { end_action(id, time_s_); }
  void end_action(std::uint32_t id, double stamp_s) {
    coarse_map_nav::MotionResult result;
    result.header.stamp = ros::Time{stamp_s};
    result.id = id;
    results_.publish(result);
  }
  static PoseMessage initial_pose(Cell cell, double yaw, double sigma_m, double sigma_rad) {
    PoseMessage message;
    message.header.frame_id = "map";
    const Point2 p = drawing().center_of(cell);
    message.pose.pose = pose_message({p.x, p.y, yaw});
    message.pose.covariance[0] = message.pose.covariance[7] = sigma_m * sigma_m;
    message.pose.covariance[35] = sigma_rad * sigma_rad;
    return message;
  }
  /// Every belief so far is a distribution over the free cells, and every pose is one.
  void expect_sane() const {
    for (const auto& belief : beliefs_.all()) {
      const double total =
          std::accumulate(belief->probability.begin(), belief->probability.end(), 0.0);
      ASSERT_NEAR(total, 1.0, 1e-4);
      const std::size_t cells = drawing().occupied().size();
      ASSERT_EQ(belief->probability.size(), 4U * cells);
      for (std::size_t i = 0; i < belief->probability.size(); ++i) {
        ASSERT_GE(belief->probability[i], 0.0F);
        if (drawing().occupied()[i % cells] != 0) {
          ASSERT_EQ(belief->probability[i], 0.0F) << "in a wall";
        }
      }
      ASSERT_TRUE(std::isfinite(belief->entropy) && std::isfinite(belief->confidence));
    }
    for (const auto& pose : poses_.all()) {
      ASSERT_TRUE(pose_of(pose->pose.pose));
      for (const double c : pose->pose.covariance) {
        ASSERT_TRUE(std::isfinite(c));
      }
    }
  }
  double drops(const std::string& reason) const {
    return diagnosed(diagnostics_, "localizer: local_occupancy", "dropped: " + reason);
  }

  double time_s_ = 100.0;
  Pose2 T_odom_robot_{0.3, -0.2, 0.1};
  bool has_odometry_ = true;
  ros::NodeHandle nh_;
  ros::Publisher clocks_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 1);
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  ros::Publisher tf_ = nh_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ros::Publisher occupancies_ = nh_.advertise<coarse_map_nav::LocalOccupancy>("local_occupancy", 5);
  ros::Publisher results_ = nh_.advertise<coarse_map_nav::MotionResult>("motion_result", 5);
  ros::Publisher initial_poses_ = nh_.advertise<PoseMessage>("initialpose", 1);
  Inbox<coarse_map_nav::Belief> beliefs_{"belief"};
  Inbox<PoseMessage> poses_{"pose"};
  Inbox<tf2_msgs::TFMessage> transforms_{"/tf"};
  Inbox<std_msgs::Empty> observes_{"observe"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  std::unique_ptr<NodeProcess> localizer_;
};

TEST_F(LocalizerTest, MapMayComeLateAndMalformedOnesAreOnlyReported) {
  nav_msgs::OccupancyGrid broken = grid_message(drawing());
  broken.data.pop_back();
  maps_.publish(broken);
  ASSERT_TRUE(
      tick_until([this] { return localizer_->output().find("[ERROR]") != std::string::npos; }));
  std_srvs::Empty empty;
  EXPECT_TRUE(ros::service::call("global_localization", empty)) << "before any map";
  initial_poses_.publish(initial_pose({5, 1}, 0.0, 0.2, 0.1));
  for (int i = 0; i < 5; ++i) {
    tick();
  }
  EXPECT_TRUE(beliefs_.empty());
  believe_anything();
  expect_sane();
  EXPECT_EQ(beliefs_.back().action_id, 0U);
}

TEST_F(LocalizerTest, OdometryMayComeLate) {
  has_odometry_ = false;
  send_map();
  ASSERT_TRUE(tick_until([this] { return drops("no transform to odom at its time") > 0.0; }))
      << localizer_->output();
  EXPECT_TRUE(beliefs_.empty());
  has_odometry_ = true;
  ASSERT_TRUE(tick_until([this] { return !beliefs_.empty(); })) << localizer_->output();
  expect_sane();
}

TEST_F(LocalizerTest, KilledAndStartedAgainItBelievesAnew) {
  believe_anything();
  localizer_->end(SIGKILL);
  beliefs_.clear();
  start_localizer();  // the map is latched
  ASSERT_TRUE(tick_until([this] { return !beliefs_.empty(); })) << localizer_->output();
  // The planner asks again for the last action; the controller answers from memory.
  end_action(17);
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 17; }));
  expect_sane();
}

TEST_F(LocalizerTest, MalformedObservationsAreDroppedAndCounted) {
  believe_anything();
  const std::size_t before = beliefs_.size();
  const std::string values = "it holds a value that is no probability or no confidence";
  const std::string size = "it has no cell size";
  const std::string count = "it says 9 cells a side and holds 80 values and 81 confidences";
  ASSERT_TRUE(tick_until([&] {
    auto nan = observation();
    nan.occupancy[4] = std::numeric_limits<float>::quiet_NaN();
    occupancies_.publish(nan);
    auto flat = observation();
    flat.resolution = 0.0F;
    occupancies_.publish(flat);
    auto cut = observation();
    cut.occupancy.pop_back();
    occupancies_.publish(cut);
    return drops(values) > 0.0 && drops(size) > 0.0 && drops(count) > 0.0;
  })) << localizer_->output();
  EXPECT_EQ(beliefs_.size(), before) << "no action has ended";
  end_action(1);
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 1; }));
  expect_sane();
}

TEST_F(LocalizerTest, EachActionIsFoldedInOnceByAnObservationNewerThanItsEnd) {
  believe_anything();
  for (std::uint32_t id = 1; id <= 4; ++id) {
    SCOPED_TRACE(id);
    const std::size_t before = beliefs_.size();
    T_odom_robot_ = T_odom_robot_ * Pose2{0.15, 0.0, 0.0};
    const double ended_s = time_s_;
    end_action(id);
    ASSERT_TRUE(tick_until([&] { return beliefs_.back().action_id == id; }));
    EXPECT_GT(beliefs_.back().header.stamp.toSec(), ended_s);
    for (int i = 0; i < 5; ++i) {
      tick();
    }
    EXPECT_EQ(beliefs_.size(), before + 1);
  }
  expect_sane();
}

TEST_F(LocalizerTest, AnAnswerThatIsRepeatedBringsTheSameBeliefAgain) {
  believe_anything();
  end_action(1);
  const double ended_s = time_s_;
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 1; }));
  const coarse_map_nav::Belief first = beliefs_.back();
  const std::size_t before = beliefs_.size();
  end_action(1, ended_s);
  ASSERT_TRUE(tick_until([&] { return beliefs_.size() > before; })) << localizer_->output();
  for (int i = 0; i < 5; ++i) {
    tick();
  }
  EXPECT_EQ(beliefs_.size(), before + 1);
  EXPECT_EQ(beliefs_.back().header.stamp, first.header.stamp);
  EXPECT_EQ(beliefs_.back().probability, first.probability);
}

TEST_F(LocalizerTest, AnEndedActionWithoutAnObservationIsAskedFor) {
  believe_anything();
  observes_.clear();
  end_action(1);
  // Time passes, perception is silent.
  ASSERT_TRUE(wait_for([this] {
    time_s_ += 0.02;
    send_clock();
    return !observes_.empty();
  })) << localizer_->output();
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 1; }));
}

TEST_F(LocalizerTest, InitialPoseIsTakenWhereItCanBeAndRefusedWhereNot) {
  believe_anything();
  initial_poses_.publish(initial_pose({8, 1}, 0.0, 0.2, 0.1));
  const auto is_there = [this] {
    const Point2 p = drawing().center_of({8, 1});
    return std::hypot(poses_.back().pose.pose.position.x - p.x,
                      poses_.back().pose.pose.position.y - p.y) < 0.85;
  };
  ASSERT_TRUE(tick_until(is_there)) << localizer_->output();
  EXPECT_GT(beliefs_.back().confidence, 0.5);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  PoseMessage in_odom = initial_pose({1, 4}, 0.0, 0.2, 0.1);
  in_odom.header.frame_id = "odom";
  PoseMessage no_pose = initial_pose({1, 4}, 0.0, 0.2, 0.1);
  no_pose.pose.pose.orientation = {};
  PoseMessage far = initial_pose({1, 4}, 0.0, 0.2, 0.1);
  far.pose.pose.position.x = 1e9;
  for (const PoseMessage& bad : {in_odom, no_pose, far}) {
    const auto errors = [this] {
      std::size_t count = 0;
      const std::string said = localizer_->output();
      for (auto at = said.find("initialpose:"); at != std::string::npos;
           at = said.find("initialpose:", at + 1)) {
        ++count;
      }
      return count;
    };
    const std::size_t before = errors();
    initial_poses_.publish(bad);
    ASSERT_TRUE(tick_until([&] { return errors() > before; }));
  }
  end_action(1);
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 1; }));
  EXPECT_TRUE(is_there()) << "a refused pose moved it";
  expect_sane();

  for (const double sigma : {nan, inf, -1.0, 0.0, 1e200}) {
    SCOPED_TRACE(sigma);
    const std::size_t before = beliefs_.size();
    PoseMessage odd = initial_pose({8, 1}, 0.0, 0.2, 0.1);
    odd.pose.covariance[0] = odd.pose.covariance[35] = sigma;
    initial_poses_.publish(odd);
    ASSERT_TRUE(tick_until([&] { return beliefs_.size() > before; })) << localizer_->output();
  }
  expect_sane();
}

TEST_F(LocalizerTest, GlobalLocalizationForgetsThePlace) {
  believe_anything();
  initial_poses_.publish(initial_pose({8, 1}, 0.0, 0.2, 0.1));
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().confidence > 0.5; }));
  const float sure = beliefs_.back().entropy;
  std_srvs::Empty empty;
  ASSERT_TRUE(ros::service::call("global_localization", empty));
  ASSERT_TRUE(tick_until([&] { return beliefs_.back().entropy > sure + 1.0F; }));
  expect_sane();
}

TEST_F(LocalizerTest, TimeThatGoesBackStartsOver) {
  believe_anything();
  initial_poses_.publish(initial_pose({8, 1}, 0.0, 0.2, 0.1));
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().confidence > 0.5; }));
  const float sure = beliefs_.back().entropy;
  time_s_ = 10.0;
  T_odom_robot_ = {};
  beliefs_.clear();
  ASSERT_TRUE(tick_until([&] { return !beliefs_.empty(); })) << localizer_->output();
  EXPECT_GT(beliefs_.back().entropy, sure + 1.0F);
  EXPECT_LT(beliefs_.back().header.stamp.toSec(), 90.0);
  end_action(3);
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 3; }));
  expect_sane();
}

TEST_F(LocalizerTest, MapToOdomPutsTheRobotWhereThePoseIs) {
  believe_anything();
  end_action(1);
  ASSERT_TRUE(tick_until([this] { return beliefs_.back().action_id == 1; }));
  const double stamp_s = poses_.back().header.stamp.toSec();
  const auto T_map_robot = pose_of(poses_.back().pose.pose);
  ASSERT_TRUE(T_map_robot);
  const auto found = [&]() -> std::optional<Pose2> {
    for (const auto& message : transforms_.all()) {
      for (const auto& transform : message->transforms) {
        // Stamped ahead by transform_tolerance_s, as amcl does.
        if (transform.header.frame_id == "map" && transform.child_frame_id == "odom" &&
            std::abs(transform.header.stamp.toSec() - 0.5 - stamp_s) < 0.01) {
          return pose_of(transform.transform);
        }
      }
    }
    return std::nullopt;
  };
  ASSERT_TRUE(tick_until([&] { return found().has_value(); }));
  const Pose2 T = *found() * T_odom_robot_;
  EXPECT_NEAR(T.x, T_map_robot->x, 1e-6);
  EXPECT_NEAR(T.y, T_map_robot->y, 1e-6);
  EXPECT_NEAR(wrap_angle(T.yaw - T_map_robot->yaw), 0.0, 1e-6);
}

TEST_F(LocalizerTest, ARepeatedObservationDoesNotRepeatTheTransform) {
  believe_anything();
  transforms_.clear();
  const auto stamps = [this] {
    std::vector<ros::Time> all;
    for (const auto& message : transforms_.all()) {
      for (const auto& transform : message->transforms) {
        if (transform.child_frame_id == "odom") {
          all.push_back(transform.header.stamp);
        }
      }
    }
    return all;
  };
  ASSERT_TRUE(tick_until([&] {
    occupancies_.publish(observation());  // that of the last tick
    return stamps().size() > 10;
  }));
  const std::vector<ros::Time> all = stamps();
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

}  // namespace
}  // namespace cmn
