// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How far the belief's estimate is from the truth, over a run.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cmn {

/// An estimate this close to the truth is right [m]; the radius of the belief's confidence.
constexpr double kRightWithin_m = 1.0;

/// What the filter believed at one moment.
struct BeliefSample {
  double stamp_s = 0.0;  ///< of the observation that was folded in last
  Pose2 T_map_robot;     ///< the estimate
  double confidence = 0.0;
  double entropy = 0.0;  ///< [nats]
  bool converged = false;
};

/// The same beside the truth; the map frame is taken for that of the truth.
struct LocalizationError {
  BeliefSample belief;
  Pose2 T_world_robot;
  double distance_m = 0.0;
  bool heading_is_right = false;  ///< less than 45 degrees off: of the four, the right one

  bool is_right() const { return distance_m <= kRightWithin_m && heading_is_right; }
};

/// Where the robot really was, as a function of time.
class TruthTrack {
 public:
  void add(double stamp_s, const Pose2& T_world_robot) { poses_[stamp_s] = T_world_robot; }
  /// Interpolated; empty before the first pose and after the last.
  std::optional<Pose2> at(double stamp_s) const;

 private:
  std::map<double, Pose2> poses_;
};

/// Beliefs of moments whose truth is not known are left out; of several with one stamp the last
/// counts. In the order of time.
std::vector<LocalizationError> errors_of(const std::vector<BeliefSample>& beliefs,
                                         const TruthTrack& truth);

struct ErrorSummary {
  std::size_t beliefs = 0;
  double duration_s = 0.0;
  double median_m = 0.0;         ///< distance, heading disregarded
  double right_share = 0.0;      ///< within 1 m and heading right
  double converged_share = 0.0;  ///< the filter says it has converged
  double false_share = 0.0;      ///< of the converged ones, those that are not right; 0 of none
  std::optional<double> first_converged_s;        ///< since the first belief
  std::optional<double> first_right_converged_s;  ///< converged and right, since the first belief
};
/// Throws std::invalid_argument when there is nothing to sum up.
ErrorSummary summary_of(const std::vector<LocalizationError>& errors);

/// For people: a row each at `rows` evenly spread moments, then the summary.
std::string table_of(const std::vector<LocalizationError>& errors, std::size_t rows);
std::string text_of(const ErrorSummary& summary);
/// One row a belief, with a line of column names (units in them).
std::string csv_of(const std::vector<LocalizationError>& errors);

}  // namespace cmn
