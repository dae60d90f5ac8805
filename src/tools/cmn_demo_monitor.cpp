// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_demo_monitor: sends the robot to a goal, watches it, leaves pictures and summary.json.

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/evaluation/run_goal.hpp"
#include "coarse_map_nav/evaluation/run_record.hpp"
#include "coarse_map_nav/evaluation/run_report.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include <actionlib/client/simple_action_client.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

namespace {

using Status = coarse_map_nav::NavigationStatus;

struct MonitorParams {
  std::string world;
  std::string map;
  std::string goal;
  std::string out = "out/demo";
  std::string map_frame = "map";
  std::string robot;
  std::string preset;
  std::uint32_t seed = 1;
  double time_limit_s = 3600.0;
  double silence_s = 120.0;
  double stall_s = 60.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    using cmn::Anything;
    using cmn::Between;
    visit("world", self.world, Anything{}, "file of the metric world, for the pictures");
    visit("map", self.map, Anything{}, "file of the drawing; its places are goals by name");
    visit("goal", self.goal, Anything{},
          "a place of the drawing or \"x y\" [m] on it; empty: the drawing's default_goal");
    visit("out", self.out, Anything{}, "folder for the pictures and summary.json");
    visit("map_frame", self.map_frame, Anything{}, "frame of the drawing");
    visit("robot", self.robot, Anything{}, "for the summary");
    visit("preset", self.preset, Anything{}, "for the summary");
    visit("seed", self.seed, Between{0, 4294967295.0}, "for the summary");
    visit("time_limit_s", self.time_limit_s, Between{1.0, 1e6}, "[s] simulated; then it gives up");
    visit("silence_s", self.silence_s, Between{1.0, 1e6},
          "[s] simulated, without a new belief; then it gives up");
    visit("stall_s", self.stall_s, Between{1.0, 1e6},
          "[s] of real time that starting up, or the simulated clock, may stand still");
  }
};

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

class DemoMonitor {
 public:
  explicit DemoMonitor(const MonitorParams& params) : params_{params}, client_{nh_, "move_base"} {
    outcome_.world = params.world;
    outcome_.map = params.map;
    outcome_.robot = params.robot;
    outcome_.preset = params.preset;
    outcome_.seed = params.seed;
    map_sub_ = nh_.subscribe("map", 1, &DemoMonitor::on_map, this);
    belief_sub_ = nh_.subscribe("belief", 50, &DemoMonitor::on_belief, this);
    status_sub_ = nh_.subscribe("status", 10, &DemoMonitor::on_status, this);
    truth_sub_ = nh_.subscribe("ground_truth", 200, &DemoMonitor::on_truth, this);
    bumper_sub_ = nh_.subscribe("bumper", 10, &DemoMonitor::on_bumper, this);
  }

  void run() {
    try {
      const auto [places, are_here] = cmn::read_places_in(params_.map, params_.world);
      outcome_.goal = cmn::goal_of(params_.goal, places, are_here);
      setting_.goal_map = outcome_.goal.map;
      setting_.goal_world = outcome_.goal.world;
      if (are_here) {
        setting_.warp = cmn::warp_to_map(places.places);
      }
      if (!params_.world.empty()) {
        setting_.world = cmn::read_map(params_.world);
      }
    } catch (const std::runtime_error& e) {
      end("FAILED", e.what());
    }
    await("a map", [this] { return map_.has_value(); });
    await("the planner", [this] { return client_.isServerConnected(); });
    // Not a first belief: that of a panorama begins with the journey.
    await("the localizer", [this] { return belief_sub_.getNumPublishers() > 0; });
    await("ground truth", [this] { return truth_.has_value() || params_.world.empty(); });
    if (ros::ok() && is_going()) {
      send_goal();
    }
    while (ros::ok() && is_going()) {
      spin(0.05);
      look_for_an_end();
    }
    if (ros::ok()) {
      finish();
    }
  }

 private:
  void spin(double wall_s) {
    const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(wall_s);
    while (ros::ok() && ros::WallTime::now() < until) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
  }

  bool is_going() const { return outcome_.state.empty(); }

  void end(const std::string& state, const std::string& reason) {
    if (is_going()) {
      outcome_.state = state;
      outcome_.reason = reason;
    }
  }

  void await(const std::string& what, const std::function<bool()>& is_there) {
    const ros::WallTime start = ros::WallTime::now();
    while (ros::ok() && is_going() && !is_there()) {
      tell("waiting for " + what);
      spin(0.05);
      if ((ros::WallTime::now() - start).toSec() > params_.stall_s) {
        end("FAILED", "waited for " + what + " in vain");
      }
    }
  }

  void send_goal() {
    start_ = ros::Time::now();
    wall_start_ = clock_moved_ = ros::WallTime::now();
    last_belief_ = last_clock_ = start_;
    is_under_way_ = true;
    if (truth_) {
      record_.add(cmn::TrackPoint{0.0, *truth_});
    }
    if (belief_) {
      record(*belief_);
    }
    move_base_msgs::MoveBaseGoal goal;
    goal.target_pose.header.frame_id = params_.map_frame;
    goal.target_pose.header.stamp = start_;
    goal.target_pose.pose = cmn::pose_message({outcome_.goal.map.x, outcome_.goal.map.y, 0.0});
    client_.sendGoal(goal);
  }

  void look_for_an_end() {
    using actionlib::SimpleClientGoalState;
    const SimpleClientGoalState state = client_.getState();
    // LOST: the planner was restarted; it goes on, and its status tells the end.
    if (state.isDone() && state != SimpleClientGoalState::LOST) {
      const bool is_preempted = state == SimpleClientGoalState::PREEMPTED;
      end(state == SimpleClientGoalState::SUCCEEDED ? "REACHED"
          : is_preempted                            ? "STOPPED"
                                                    : "FAILED",
          state.getText());
    }
    const ros::Time now = ros::Time::now();
    if (now != last_clock_) {
      last_clock_ = now;
      clock_moved_ = ros::WallTime::now();
    }
    if ((now - start_).toSec() > params_.time_limit_s) {
      end("FAILED", text_of("time: not there after %.0f s", params_.time_limit_s));
    }
    if ((now - last_belief_).toSec() > params_.silence_s) {
      end("FAILED", text_of("time: no belief for %.0f s", params_.silence_s));
    }
    if ((ros::WallTime::now() - clock_moved_).toSec() > params_.stall_s) {
      end("FAILED", "time: the simulated clock stands still");
    }
  }

  void on_map(const nav_msgs::OccupancyGrid& grid) {
    std::string why;
    map_ = cmn::map_of(grid, why);
    if (map_) {
      setting_.map = *map_;
    } else {
      end("FAILED", "map: " + why);
    }
  }

  void on_belief(const coarse_map_nav::Belief::ConstPtr& msg) {
    belief_ = msg;
    if (is_under_way_) {
      last_belief_ = ros::Time::now();
      record(*msg);
    }
  }

  void record(const coarse_map_nav::Belief& msg) {
    std::string why;
    const auto received = cmn::belief_of(msg, setting_.map, why);
    const auto estimate = cmn::pose_of(msg.estimate);
    if (!received || !estimate) {
      ROS_WARN_STREAM_THROTTLE(5.0, "belief: dropped, " << why);
      return;
    }
    cmn::RunMoment moment;
    moment.time_s = std::max(0.0, (msg.header.stamp - start_).toSec());
    const cmn::Grid<double> marginal = cmn::marginal(received->belief);
    moment.marginal = cmn::Grid<float>(marginal.width(), marginal.height());
    std::transform(marginal.values().begin(), marginal.values().end(),
                   moment.marginal.values().begin(),
                   [](double p) { return static_cast<float>(p); });
    moment.T_map_estimate = *estimate;
    moment.confidence = static_cast<double>(msg.confidence);
    moment.converged = msg.converged != 0;
    moment.T_world_robot = record_.truth_at(moment.time_s);
    record_.add(std::move(moment));
  }

  void on_status(const Status& msg) {
    constexpr std::array<const char*, 6> kNames{"WAITING_FOR_MAP", "LOCALIZING", "NAVIGATING",
                                                "REACHED",         "FAILED",     "STOPPED"};
    if (!is_under_way_ || msg.header.stamp < start_ || msg.state >= kNames.size()) {
      return;
    }
    const std::string state = kNames[msg.state];
    outcome_.actions = msg.actions;
    const double to_go_m = static_cast<double>(msg.distance_to_go);
    const bool is_over = msg.state == Status::REACHED || msg.state == Status::FAILED;
    tell(text_of("%-10s  belief %3.0f %%  to go %s  %3u actions  %4.0f s", state.c_str(),
                 100.0 * static_cast<double>(msg.confidence),
                 std::isfinite(to_go_m) ? text_of("%4.1f m", to_go_m).c_str() : "   - m",
                 outcome_.actions, (msg.header.stamp - start_).toSec()),
         is_over);
    if (is_over) {
      end(state, msg.text);
    }
  }

  void on_truth(const nav_msgs::Odometry& msg) {
    truth_ = cmn::pose_of(msg.pose.pose);
    if (is_under_way_ && truth_ && msg.header.stamp >= start_) {
      record_.add(cmn::TrackPoint{(msg.header.stamp - start_).toSec(), *truth_});
    }
  }

  void on_bumper(const std_msgs::Bool& msg) {
    outcome_.collisions += is_under_way_ && msg.data != 0 ? 1 : 0;
  }

  /// A line for people, at most five a second.
  void tell(const std::string& line, bool always = false) {
    const ros::WallTime now = ros::WallTime::now();
    if (always || (now - told_).toSec() >= 0.2) {
      told_ = now;
      std::printf("demo: %s\n", line.c_str());
      std::fflush(stdout);
    }
  }

  void finish() {
    if (is_under_way_) {
      outcome_.wall_time_s = (ros::WallTime::now() - wall_start_).toSec();
      if (!client_.getState().isDone()) {
        client_.cancelGoal();
      }
    }
    spin(0.2);  // the last status and belief
    is_under_way_ = false;
    outcome_.T_world_end = truth_;
    cmn::write_run_report(params_.out, setting_, record_, outcome_);
    tell(outcome_.state + ": " + outcome_.reason, true);
  }

  ros::NodeHandle nh_;
  MonitorParams params_;
  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client_;
  cmn::RunOutcome outcome_;  ///< its state is empty while it is under way
  cmn::RunSetting setting_;
  cmn::RunRecord record_;
  std::optional<cmn::CoarseMap> map_;
  coarse_map_nav::Belief::ConstPtr belief_;
  std::optional<cmn::Pose2> truth_;
  bool is_under_way_ = false;
  ros::Time start_;
  ros::Time last_belief_;
  ros::Time last_clock_;
  ros::WallTime wall_start_;
  ros::WallTime clock_moved_;
  ros::WallTime told_;
  ros::Subscriber map_sub_;
  ros::Subscriber belief_sub_;
  ros::Subscriber status_sub_;
  ros::Subscriber truth_sub_;
  ros::Subscriber bumper_sub_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "demo_monitor");
  const auto params = cmn::load_params_or_exit<MonitorParams>(ros::NodeHandle("~"));
  try {
    DemoMonitor{params}.run();
  } catch (const std::exception& e) {
    cmn::exit_with({e.what()});
  }
  return 0;
}
