// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether a localizer finds a real robot, whose log is played to it from some moment on.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/evaluation/carmen_log.hpp"
#include "coarse_map_nav/evaluation/odometry_noise.hpp"
#include "coarse_map_nav/params.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cmn {

/// A run ends `hold_m` after the `find_m` that the filter has for finding the robot; it is found
/// when from there on every estimate is within `within_m` of the truth and faces the right way.
struct RecordedRunParams {
  double find_m = 20.0;
  double hold_m = 20.0;
  double within_m = 1.5;
  /// 5 % of the way and 5 % of the turning, constant over a run (1 sigma), beside the noise of
  /// every base.
  OdometryNoiseParams noise{0.02, 1.0, 0.2, 0.05, 0.05};
};

/// The estimate after one look, beside the truth.
struct RecordedLook {
  double driven_m = 0.0;  ///< since the start, in truth
  double error_m = 0.0;
  double yaw_error_rad = 0.0;  ///< estimate less truth
  double confidence = 0.0;
  bool is_converged = false;
  Pose2 T_world_robot;
  double scale = 1.0;
  /// Less than 45 degrees off: of the four quarters the right one.
  bool faces_right() const { return yaw_error_rad < kPi / 4.0 && yaw_error_rad > -kPi / 4.0; }
};

struct RecordedRun {
  std::string building;
  std::string method;  ///< preset, and what was changed of it
  int index = 0;
  double start_s = 0.0;  ///< of the log
  std::vector<RecordedLook> looks;

  /// Whether every look from `from_m` on is right; false when there is none.
  bool is_right_from(double from_m, double within_m) const;
  /// From where on all is right; infinity: not even the last look is.
  double found_m(double within_m) const;
};

/// A log whose poses are those of a world map.
struct RecordedDrive {
  RecordedDrive(const CarmenLog& log, const Pose2& T_world_log);

  std::vector<double> stamps_s;  ///< of each pose
  std::vector<Pose2> truth;      ///< world -> robot
  std::vector<double> driven_m;  ///< up to each pose
  std::vector<CarmenScan> scans;
};

/// `count` scans, each as likely, from which there is `needed_m` left to drive; in their order.
/// Throws std::invalid_argument when the drive is shorter.
std::vector<std::size_t> random_starts(const RecordedDrive& drive, double needed_m, int count,
                                       std::uint64_t seed);

/// Plays the drive from a scan on: every scan to perception, a look to the localizer after each
/// 0.15 m or quarter turn (UpdateGate). The start is unknown, odometry is made of the truth with
/// seeded drift; its axes lie along the world's at the start. `drawing` has the world's map frame.
std::vector<RecordedLook> play(const RecordedDrive& drive, std::size_t first_scan,
                               const CoarseMap& drawing, const NavigatorParams& navigator,
                               const RecordedRunParams& params, std::uint32_t seed);

/// One row a run, with a line of column names.
std::string csv_of(const std::vector<RecordedRun>& runs, const RecordedRunParams& params);
/// One row a look, likewise.
std::string looks_csv_of(const std::vector<RecordedRun>& runs);
/// For documents (markdown): a row a building and a column a method, with Wilson intervals, and
/// all buildings together.
std::string table_of(const std::vector<RecordedRun>& runs, const RecordedRunParams& params);
/// For scripts: RESULT lines.
std::string results_of(const std::vector<RecordedRun>& runs, const RecordedRunParams& params);
/// Error against metres driven (SVG): median and quartiles over the runs, a panel a building.
/// `runs` must not be empty.
std::string recorded_plot(const std::vector<RecordedRun>& runs, const RecordedRunParams& params);

}  // namespace cmn
