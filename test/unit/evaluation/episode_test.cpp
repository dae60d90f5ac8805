// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode.hpp"

#include <algorithm>
#include <string>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// A depth camera that sees nothing in the way until the robot leaves its place, and then a wall
/// before its nose for good.
class SuddenWall : public SceneSensors {
 public:
  explicit SuddenWall(Point2 start) : start_{start} {
    T_robot_camera_.translation() = Eigen::Vector3d{0.0, 0.0, 0.4};
    T_robot_camera_.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  }
  RangeScan scan(const Pose2& /*T_world_robot*/, double /*stamp_s*/) override {
    ADD_FAILURE() << "it has no LiDAR";
    return {};
  }
  DepthImage depth(const Pose2& T_world_robot, double stamp_s) override {
    has_moved_ = has_moved_ || norm(T_world_robot.position() - start_) > kAway_m;
    const auto camera = CameraModel::from_field_of_view(80, 60, 1.3);
    const cv::Mat depth_m(60, 80, CV_32FC1, cv::Scalar{has_moved_ ? 0.2 : 3.0});
    return {stamp_s, camera, T_robot_camera_, depth_m};
  }
  ColorImage color(const Pose2& /*T_world_robot*/, double /*stamp_s*/) override { return {}; }

 private:
  static constexpr double kAway_m = 0.02;  ///< turning on the spot slips by less
  Point2 start_;
  bool has_moved_ = false;
  Eigen::Isometry3d T_robot_camera_ = Eigen::Isometry3d::Identity();
};

TEST(RunEpisode, ADepthCameraGuardsTheMotionWhereThereIsNoLidar) {
  const CoarseMap map = ascii_map({"##########", "#........#", "#........#", "##########"}, 1.0);
  NavigatorParams params;
  ASSERT_TRUE(load_params(read_param_file(CMN_SOURCE_DIR "/config/random.yaml"), params).empty());
  params.perception.source = "depth";
  params.perception.guard.type = "footprint";
  params.planning.max_actions = 40;
  const Pose2 start{2.5, 2.0, 0.0};
  SuddenWall sensors{start.position()};
  const EpisodeResult result =
      run_episode(World{map}, SimulationParams{}, map, params, {start, {7.5, 1.5}}, 1, &sensors);
  const auto blocked = std::count_if(
      result.steps.begin(), result.steps.end(),
      [](const EpisodeStep& step) { return step.outcome == MotionOutcome::kBlocked; });
  EXPECT_EQ(blocked, 1) << result.reason;
  EXPECT_LT(norm(result.T_world_end.position() - start.position()), 0.1)
      << "a whole step has 0.15 m";
  EXPECT_EQ(result.collisions, 0);
}

}  // namespace
}  // namespace cmn
