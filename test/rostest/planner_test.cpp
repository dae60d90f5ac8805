// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include "ros_graph.hpp"
#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/OccupancyGrid.h>
#include <std_msgs/Empty.h>

namespace cmn {
namespace {

using coarse_map_nav::DiscreteAction;
using coarse_map_nav::NavigationStatus;
using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;
using ClientState = actionlib::SimpleClientGoalState;

const CoarseMap& drawing() {
  static const CoarseMap map = ascii_map({"##########",  //
                                          "#........#",  //
                                          "#.####...#",  //
                                          "#........#",  //
                                          "##########"},
                                         0.5);
  return map;
}
constexpr Cell kStart{1, 1};
constexpr Cell kGoal{6, 1};
constexpr Cell kWall{3, 2};

/// A planner; the test is map server, localizer, base and user.
class PlannerTest : public testing::Test {
 protected:
  void SetUp() override {
    start_planner();
    ASSERT_TRUE(wait_for([this] { return client_.isServerConnected(); })) << planner_->output();
  }
  void TearDown() override {
    planner_.reset();
    ros::param::del("/planner");
    ros::param::del("/goal_under_way");
  }

  virtual std::vector<std::string> parameters() const {
    return {"_resend_after_s:=0.5", "_planning/policy:=path", "_planning/step_m:=0.5"};
  }

  void start_planner() {
    planner_ = std::make_unique<NodeProcess>("planner", parameters());
    ASSERT_TRUE(wait_for([this] {
      return maps_.getNumSubscribers() > 0 && beliefs_.getNumSubscribers() > 0 &&
             occupancies_.getNumSubscribers() > 0 && results_.getNumSubscribers() > 0 &&
             simple_goals_.getNumSubscribers() > 0 && actions_.is_connected() &&
             statuses_.is_connected() && diagnostics_.is_connected();
    })) << planner_->output();
  }

  void send_map() { send_map(drawing()); }
  void send_map(const CoarseMap& map) {
    nav_msgs::OccupancyGrid grid = grid_message(map);
    grid.header.frame_id = "map";
    statuses_.clear();
    maps_.publish(grid);
    ASSERT_TRUE(wait_for([this] { return !statuses_.empty(); })) << planner_->output();
  }

  static coarse_map_nav::Belief belief_at(Cell cell, std::uint32_t action_id) {
    Belief belief{drawing().width(), drawing().height()};
    belief.set_weight(Heading::kEast, cell, 1.0);
    EXPECT_TRUE(belief.normalise());
    coarse_map_nav::Belief message = message_of(
        {belief, {Heading::kEast, cell, 1.0}, middle_of(cell), 0.0, 1.0, true}, drawing());
    message.header.frame_id = "map";
    message.header.stamp = ros::Time::now();
    message.action_id = action_id;
    return message;
  }
  void believe(Cell cell, std::uint32_t action_id) {
    const coarse_map_nav::Belief belief = belief_at(cell, action_id);
    coarse_map_nav::LocalOccupancy seen = message_of(LocalOccupancy{9, 0.2}, belief.header);
    seen.header.frame_id = "base_link";
    occupancies_.publish(seen);
    beliefs_.publish(belief);
  }

  static move_base_msgs::MoveBaseGoal goal_at(Point2 p, const std::string& frame = "map") {
    move_base_msgs::MoveBaseGoal goal;
    goal.target_pose.header.frame_id = frame;
    goal.target_pose.pose = pose_message({p.x, p.y, 0.0});
    return goal;
  }
  static move_base_msgs::MoveBaseGoal goal_at(Cell cell) {
    return goal_at(drawing().center_of(cell));
  }
  bool has_ended() { return client_.getState().isDone(); }
  /// Waits for an order to move, from now on.
  void expect_order(std::uint32_t id) {
    ASSERT_TRUE(wait_for([&] {
      return !actions_.empty() && actions_.back().id == id &&
             actions_.back().type != DiscreteAction::STOP;
    })) << planner_->output();
  }
  void set_out() {
    send_map();
    believe(kStart, 0);
    client_.sendGoal(goal_at(kGoal));
    expect_order(1);
  }
  /// Sends a goal that has to be refused; returns why.
  std::string refusal_of(const move_base_msgs::MoveBaseGoal& goal) {
    client_.sendGoal(goal);
    EXPECT_TRUE(wait_for([this] { return has_ended(); })) << planner_->output();
    EXPECT_EQ(client_.getState(), ClientState::ABORTED);
    return client_.getState().getText();
  }

  ros::NodeHandle nh_;
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  ros::Publisher beliefs_ = nh_.advertise<coarse_map_nav::Belief>("belief", 1, true);
  ros::Publisher occupancies_ = nh_.advertise<coarse_map_nav::LocalOccupancy>("local_occupancy", 5);
  ros::Publisher results_ = nh_.advertise<coarse_map_nav::MotionResult>("motion_result", 5);
  ros::Publisher simple_goals_ =
      nh_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  Inbox<DiscreteAction> actions_{"action"};
  Inbox<NavigationStatus> statuses_{"status"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  Client client_{"move_base", true};
  std::unique_ptr<NodeProcess> planner_;
};

TEST_F(PlannerTest, GoalsThatCannotBeAreRejectedWithAReason) {
  EXPECT_NE(refusal_of(goal_at(kGoal)).find("there is no map yet"), std::string::npos);
  send_map();
  believe(kStart, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string occupied = refusal_of(goal_at(kWall));
  EXPECT_NE(occupied.find("(3, 2), which is occupied"), std::string::npos) << occupied;
  const std::string outside = refusal_of(goal_at(Point2{-3.0, 1.0}));
  EXPECT_NE(outside.find("lies outside the drawing"), std::string::npos) << outside;
  const std::string far = refusal_of(goal_at(Point2{1e30, 1.0}));
  EXPECT_NE(far.find("lies outside the drawing"), std::string::npos) << far;
  const std::string none = refusal_of(goal_at(Point2{nan, 1.0}));
  EXPECT_NE(none.find("is not a point"), std::string::npos) << none;
  for (const std::string frame : {"odom", "", "base_link"}) {
    const std::string other = refusal_of(goal_at(drawing().center_of(kGoal), frame));
    EXPECT_NE(other.find("goals are marked on the drawing, in \"map\""), std::string::npos)
        << other;
  }
  for (const auto& action : actions_.all()) {
    EXPECT_EQ(action->type, DiscreteAction::STOP) << "it moves without a goal";
  }
  client_.sendGoal(goal_at(kGoal));
  expect_order(1);
}

TEST_F(PlannerTest, TurnsRoundWhilePerceptionHasSeenOnlyAPartAndDoesNotCountThat) {
  send_map();
  client_.sendGoal(goal_at(kGoal));
  const auto look = [this](bool is_partial) {
    std_msgs::Header header;
    header.stamp = ros::Time::now();
    header.frame_id = "base_link";
    coarse_map_nav::LocalOccupancy seen = message_of(LocalOccupancy{9, 0.2}, header);
    seen.partial = static_cast<std::uint8_t>(is_partial);
    occupancies_.publish(seen);
  };
  for (std::uint32_t id = 1; id <= 4; ++id) {
    SCOPED_TRACE(id);
    ASSERT_TRUE(wait_for([&] {
      look(true);
      return wait_for([&] { return !actions_.empty() && actions_.back().id == id; }, 0.1);
    })) << planner_->output();
    EXPECT_EQ(actions_.back().type, DiscreteAction::TURN_LEFT);
    look(true);
    EXPECT_FALSE(wait_for([&] { return actions_.back().id > id; }, 0.2)) << "it is still turning";
    coarse_map_nav::MotionResult result;
    result.id = id;
    result.header.stamp = ros::Time::now();
    results_.publish(result);
  }
  believe(kStart, 4);
  expect_order(5);
  ASSERT_TRUE(wait_for([this] { return statuses_.back().actions == 1; })) << planner_->output();
  EXPECT_GE(statuses_.back().pivots, 4U);
}

TEST_F(PlannerTest, TheCycleOfActionsLeadsToTheGoalAndEndsThere) {
  set_out();
  believe({2, 1}, 1);
  expect_order(2);
  believe({2, 1}, 1);  // a belief that knows nothing of action 2
  believe(kGoal, 2);
  ASSERT_TRUE(wait_for([this] { return has_ended(); })) << planner_->output();
  EXPECT_EQ(client_.getState(), ClientState::SUCCEEDED);
  ASSERT_TRUE(wait_for([this] {
    return statuses_.back().state == NavigationStatus::REACHED &&
           actions_.back().type == DiscreteAction::STOP;
  }));
  for (const auto& action : actions_.all()) {
    EXPECT_LE(action->id, 2U);
  }
}

TEST_F(PlannerTest, ACancelledGoalStopsTheRobot) {
  set_out();
  client_.cancelGoal();
  ASSERT_TRUE(wait_for([this] {
    return has_ended() && actions_.back().type == DiscreteAction::STOP &&
           statuses_.back().state == NavigationStatus::STOPPED;
  })) << planner_->output();
  EXPECT_EQ(client_.getState(), ClientState::PREEMPTED);
  actions_.clear();
  believe({2, 1}, 1);
  believe({2, 1}, 2);
  client_.sendGoal(goal_at(kGoal));
  ASSERT_TRUE(wait_for([this] { return !actions_.empty(); })) << "the next goal works as ever";
  EXPECT_NE(actions_.all().front()->type, DiscreteAction::STOP);
}

TEST_F(PlannerTest, A2dNavGoalTakesOverAndABadOneIsOnlyReported) {
  set_out();
  geometry_msgs::PoseStamped bad = goal_at(kGoal).target_pose;
  bad.header.frame_id = "odom";
  geometry_msgs::PoseStamped good = goal_at(Cell{8, 1}).target_pose;
  simple_goals_.publish(good);
  ASSERT_TRUE(wait_for([this] { return has_ended(); })) << planner_->output();
  EXPECT_EQ(client_.getState(), ClientState::PREEMPTED);
  believe({2, 1}, 1);
  expect_order(2);
  simple_goals_.publish(bad);
  ASSERT_TRUE(
      wait_for([this] { return planner_->output().find("goal refused") != std::string::npos; }));
  believe({8, 1}, 2);
  ASSERT_TRUE(wait_for([this] { return statuses_.back().state == NavigationStatus::REACHED; }));
}

TEST_F(PlannerTest, AnActionWithoutAnAnswerIsSentAgainUnchanged) {
  set_out();
  const DiscreteAction first = actions_.back();
  actions_.clear();
  ASSERT_TRUE(wait_for([this] { return actions_.size() >= 3; })) << planner_->output();
  for (const auto& again : actions_.all()) {
    EXPECT_EQ(again->id, first.id);
    EXPECT_EQ(again->type, first.type);
    EXPECT_EQ(again->distance, first.distance);
  }
}

TEST_F(PlannerTest, MalformedBeliefsAreDroppedAndCountedAndOrderNothing) {
  set_out();
  coarse_map_nav::Belief small = belief_at(kGoal, 1);
  small.info.width = 3;
  coarse_map_nav::Belief cut = belief_at(kGoal, 1);
  cut.probability.resize(7);
  coarse_map_nav::Belief nan = belief_at(kGoal, 1);
  nan.probability[3] = std::numeric_limits<float>::quiet_NaN();
  coarse_map_nav::Belief zero = belief_at(kGoal, 1);
  zero.probability.assign(zero.probability.size(), 0.0F);
  const auto drops = [this](const std::string& reason) {
    return diagnosed(diagnostics_, "planner: belief", "dropped: " + reason);
  };
  ASSERT_TRUE(wait_for([&] {
    for (const auto& belief : {small, cut, nan, zero}) {
      beliefs_.publish(belief);
    }
    return drops("it is not one over four headings and the cells of this map") > 0.0 &&
           drops("it holds no distribution or its estimate lies off the map") > 0.0;
  })) << planner_->output();
  EXPECT_FALSE(has_ended());
  EXPECT_EQ(actions_.back().id, 1U);
  believe({2, 1}, 1);
  expect_order(2);
}

TEST_F(PlannerTest, KilledAndStartedAgainItGoesOnToTheGoal) {
  set_out();
  planner_->end(SIGKILL);
  actions_.clear();
  statuses_.clear();
  start_planner();  // map and belief are latched
  expect_order(1);
  believe(kGoal, 1);
  ASSERT_TRUE(wait_for([this] {
    return !statuses_.empty() && statuses_.back().state == NavigationStatus::REACHED;
  })) << planner_->output();

  const auto is_forgotten = [] { return !ros::param::has("/goal_under_way"); };
  EXPECT_TRUE(wait_for(is_forgotten));
  simple_goals_.publish(goal_at(kGoal).target_pose);  // it is there already
  statuses_.clear();
  ASSERT_TRUE(wait_for([this] {
    return !statuses_.empty() && statuses_.back().state == NavigationStatus::REACHED;
  })) << planner_->output();

  EXPECT_TRUE(wait_for(is_forgotten));

  // Once there, there is nothing left to go on with.
  planner_->end(SIGKILL);
  statuses_.clear();
  actions_.clear();
  start_planner();
  ASSERT_TRUE(wait_for([this] {
    return !statuses_.empty() && statuses_.back().text == "waiting for a goal";
  })) << planner_->output();
  for (const auto& action : actions_.all()) {
    EXPECT_EQ(action->type, DiscreteAction::STOP);
  }
}

TEST_F(PlannerTest, AMalformedMapIsReportedAndTheNextGoodOneTaken) {
  nav_msgs::OccupancyGrid grid = grid_message(drawing());
  grid.data.pop_back();
  maps_.publish(grid);
  ASSERT_TRUE(wait_for([this] { return planner_->output().find("[ERROR]") != std::string::npos; }));
  EXPECT_TRUE(planner_->is_running());
  set_out();
}

TEST_F(PlannerTest, AnotherMapOnTheWayEndsAJourneyWhoseGoalItDoesNotHave) {
  set_out();
  send_map(ascii_map({"####",  //
                      "#..#",  //
                      "####"},
                     0.5));
  ASSERT_TRUE(wait_for([this] { return has_ended(); })) << planner_->output();
  EXPECT_EQ(client_.getState(), ClientState::ABORTED);
  ASSERT_TRUE(wait_for([this] { return actions_.back().type == DiscreteAction::STOP; }));
}

/// Ours: decides on the belief and on what is seen around the robot together.
class BeliefPlannerTest : public PlannerTest {
 protected:
  std::vector<std::string> parameters() const override {
    return {"_resend_after_s:=0.5", "_planning/policy:=belief", "_planning/step_m:=0.15"};
  }
  void SetUp() override {
    PlannerTest::SetUp();
    ASSERT_TRUE(wait_for([this] {
      return local_maps_.getNumSubscribers() > 0 && observes_.is_connected() &&
             repaired_.is_connected();
    })) << planner_->output();
  }
  void see_open_ground(const ros::Time& stamp) {
    LocalOccupancy local{80, 0.05};
    local.occupancy.assign(local.cell_count(), 0.0F);
    local.confidence.assign(local.cell_count(), 1.0F);
    std_msgs::Header header;
    header.stamp = stamp;
    header.frame_id = "base_link";
    local_maps_.publish(message_of(local, header));
  }
  bool has_order() const {
    return !actions_.empty() && actions_.back().type != DiscreteAction::STOP;
  }

  ros::Publisher local_maps_ = nh_.advertise<coarse_map_nav::LocalOccupancy>("local_map", 5);
  Inbox<std_msgs::Empty> observes_{"observe"};
  Inbox<nav_msgs::OccupancyGrid> repaired_{"repaired_map"};
};

TEST_F(BeliefPlannerTest, OrdersNothingBeforeItKnowsWhatIsAroundIt) {
  send_map();
  coarse_map_nav::Belief belief = belief_at(kStart, 0);
  belief.axes_yaw = 0.25F;
  see_open_ground(belief.header.stamp - ros::Duration(0.1));  // of before the belief: stale
  beliefs_.publish(belief);
  client_.sendGoal(goal_at(kGoal));
  ASSERT_TRUE(wait_for([this] {
    return statuses_.back().text.find("waiting for local_map") != std::string::npos &&
           observes_.size() >= 2;
  })) << planner_->output();
  EXPECT_FALSE(has_order());
  EXPECT_NE(planner_->output().find("waiting for local_map"), std::string::npos);
  see_open_ground(belief.header.stamp);
  expect_order(1);
  EXPECT_EQ(actions_.back().axes_yaw, 0.25F) << "it goes along the axes of the belief";
  ASSERT_TRUE(wait_for([this] { return !repaired_.empty(); })) << "what it plans on is shown";
  EXPECT_GT(repaired_.back().info.width, 0U);
}

TEST_F(BeliefPlannerTest, TakesALaterLookWhenThatOfTheBeliefWasLost) {
  send_map();
  const coarse_map_nav::Belief belief = belief_at(kStart, 0);
  beliefs_.publish(belief);
  client_.sendGoal(goal_at(kGoal));
  ASSERT_TRUE(wait_for([this] { return !observes_.empty(); })) << planner_->output();
  see_open_ground(belief.header.stamp + ros::Duration(3.0));
  expect_order(1);
  actions_.clear();
  client_.cancelGoal();
  ASSERT_TRUE(wait_for([this] { return has_ended(); }));
}

}  // namespace
}  // namespace cmn
