// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recorded LiDAR logs in CARMEN's text format, as the robotics data sets of the 2000s have them.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace cmn {

/// Ranges from here on are a beam that met nothing [m] (SICK scanners report 50 to 82 m then).
constexpr double kCarmenMaxRange_m = 50.0;

/// Where the robot was, in the log's own frame.
struct CarmenPose {
  double stamp_s = 0.0;
  Pose2 T_log_robot;
};

/// One sweep over 180 degrees: the first beam at -90, the last at +90, evenly spread.
struct CarmenScan {
  std::size_t pose = 0;  ///< index into CarmenLog::poses; the scanner is at the robot's origin
  std::vector<float> ranges_m;  ///< +inf where the beam met nothing, NaN where there is no number
};

/// A line that could not be used.
struct CarmenProblem {
  std::size_t line = 0;  ///< counted from 1
  std::string text;      ///< what is wrong with it
};

struct CarmenLog {
  std::vector<CarmenPose> poses;  ///< stamps strictly increasing; one for every scan among them
  std::vector<CarmenScan> scans;  ///< in the order of their poses
  std::map<std::string, std::string> params;  ///< PARAM lines, the last one of a name

  std::vector<CarmenProblem> malformed;  ///< skipped
  std::size_t other_lines = 0;           ///< comments and messages of other kinds, skipped
  std::size_t repeated_poses = 0;        ///< ODOM lines that only repeat a scan's pose, skipped
  std::size_t moved_stamps = 0;          ///< out of order, spread between their neighbours
  bool has_clock = true;  ///< false: stamps too coarse to order the lines, 10 Hz assumed
};

/// Parses FLASER, ODOM and PARAM lines.
///
///     FLASER n r1 .. rn  x y theta  odom_x odom_y odom_theta  stamp host stamp
///     ODOM x y theta tv rv accel stamp host stamp
///
/// In a SLAM-corrected log the pose of a FLASER line is the corrected one (x y theta) and the ODOM
/// lines up to the next are raw odometry carried on from it, which so jumps at every scan. Here the
/// jump is spread over the stretch between the two scans in proportion to the motion, so that
/// `poses` is a smooth path through every corrected pose.
///
/// Throws std::runtime_error when there is not a single usable scan.
CarmenLog parse_carmen_log(const std::string& text);

/// Reads a file, plain or gzip-compressed. Throws std::runtime_error naming the file.
CarmenLog read_carmen_log(const std::string& path);

}  // namespace cmn
