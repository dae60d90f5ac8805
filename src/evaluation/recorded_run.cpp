// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/recorded_run.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/localization/update_gate.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/perception/rolling_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

namespace cmn {
namespace {

RangeScan scan_of(const CarmenScan& sweep, double stamp_s) {
  RangeScan scan;
  scan.stamp_s = stamp_s;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_increment_rad = kPi / static_cast<double>(sweep.ranges_m.size() - 1);
  scan.range_max_m = kCarmenMaxRange_m;
  scan.ranges_m = sweep.ranges_m;
  return scan;
}

}  // namespace

bool RecordedRun::is_right_from(double from_m, double within_m) const {
  return !looks.empty() && looks.back().driven_m >= from_m && found_m(within_m) <= from_m;
}

double RecordedRun::found_m(double within_m) const {
  double found = std::numeric_limits<double>::infinity();
  for (auto look = looks.rbegin(); look != looks.rend(); ++look) {
    if (look->error_m > within_m || !look->faces_right()) {
      break;
    }
    found = look->driven_m;
  }
  return found;
}

RecordedDrive::RecordedDrive(const CarmenLog& log, const Pose2& T_world_log) : scans{log.scans} {
  double sum = 0.0;
  for (const CarmenPose& pose : log.poses) {
    const Pose2 T_world_robot = T_world_log * pose.T_log_robot;
    sum += truth.empty() ? 0.0 : norm(T_world_robot.position() - truth.back().position());
    stamps_s.push_back(pose.stamp_s);
    truth.push_back(T_world_robot);
    driven_m.push_back(sum);
  }
}

std::vector<std::size_t> random_starts(const RecordedDrive& drive, double needed_m, int count,
                                       std::uint64_t seed) {
  std::vector<std::size_t> possible;
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    if (drive.driven_m.back() - drive.driven_m[drive.scans[i].pose] >= needed_m) {
      possible.push_back(i);
    }
  }
  if (possible.empty()) {
    throw std::invalid_argument("only " + std::to_string(drive.driven_m.back()) +
                                " m are driven, and a run needs " + std::to_string(needed_m));
  }
  std::mt19937_64 rng{seed};
  std::vector<std::size_t> starts;
  for (int i = 0; i < count; ++i) {
    starts.push_back(possible[draw_index(rng, possible.size())]);
  }
  std::sort(starts.begin(), starts.end());
  return starts;
}

std::vector<RecordedLook> play(const RecordedDrive& drive, std::size_t first_scan,
                               const CoarseMap& drawing, const NavigatorParams& navigator,
                               const RecordedRunParams& params, std::uint32_t seed) {
  const std::size_t first_pose = drive.scans[first_scan].pose;
  const double end_m = drive.driven_m[first_pose] + params.find_m + params.hold_m;
  std::size_t end_pose = first_pose;
  while (end_pose < drive.truth.size() && drive.driven_m[end_pose] <= end_m) {
    ++end_pose;
  }
  const std::vector<Pose2> odometry = drifting_odometry(
      {drive.truth.begin() + static_cast<std::ptrdiff_t>(first_pose),
       drive.truth.begin() +
           static_cast<std::ptrdiff_t>(std::min(end_pose + 1, drive.truth.size()))},
      params.noise, seed);

  LocalizationParams localization = navigator.localization;
  localization.seed = seed;
  const std::unique_ptr<Localizer> localizer = make_localizer(drawing, localization);
  RangeProjector projector{navigator.perception.local_occupancy};
  RollingMap rolling{navigator.perception.rolling};
  const bool is_rolling = navigator.perception.accumulate == "rolling";
  UpdateGateParams gate_params;
  gate_params.update_on = "motion";
  UpdateGate gate{gate_params};

  std::vector<RecordedLook> looks;
  for (std::size_t i = first_scan; i < drive.scans.size() && drive.scans[i].pose < end_pose; ++i) {
    const std::size_t pose = drive.scans[i].pose;
    const double stamp_s = drive.stamps_s[pose];
    const Pose2& T_odom_robot = odometry[pose - first_pose];
    const bool is_due = gate.is_due(stamp_s, T_odom_robot);
    if (!is_due && !is_rolling) {
      continue;
    }
    LocalOccupancy seen = projector.project(scan_of(drive.scans[i], stamp_s));
    if (is_rolling) {
      seen = rolling.fuse(seen, T_odom_robot);
    }
    if (!is_due) {
      continue;
    }
    localizer->update(seen, T_odom_robot);
    const Localization at = localizer->localization();
    const Pose2 T_map_robot = pose_in_map(drawing, at);
    RecordedLook look;
    look.driven_m = drive.driven_m[pose] - drive.driven_m[first_pose];
    look.T_world_robot = drive.truth[pose];
    look.error_m = norm(T_map_robot.position() - look.T_world_robot.position());
    look.yaw_error_rad = wrap_angle(T_map_robot.yaw - look.T_world_robot.yaw);
    look.confidence = at.confidence;
    look.is_converged = at.is_converged;
    look.scale = at.scale;
    looks.push_back(look);
  }
  return looks;
}

}  // namespace cmn
