// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/localization_error.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace cmn {
namespace {

constexpr double kDegPerRad = 180.0 / kPi;

double since_start(const std::vector<LocalizationError>& errors, const LocalizationError& error) {
  return error.belief.stamp_s - errors.front().belief.stamp_s;
}

std::string seconds_text(const std::optional<double>& seconds) {
  if (!seconds) {
    return "never";
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "after " << *seconds << " s";
  return text.str();
}

}  // namespace

std::optional<Pose2> TruthTrack::at(double stamp_s) const {
  const auto after = poses_.lower_bound(stamp_s);
  if (after == poses_.end() || (after == poses_.begin() && after->first != stamp_s)) {
    return std::nullopt;
  }
  if (after->first == stamp_s) {
    return after->second;
  }
  const auto before = std::prev(after);
  const double share = (stamp_s - before->first) / (after->first - before->first);
  const Pose2& from = before->second;
  const Pose2& to = after->second;
  const Point2 p = from.position() + share * (to.position() - from.position());
  return Pose2{p.x, p.y, wrap_angle(from.yaw + share * wrap_angle(to.yaw - from.yaw))};
}

std::vector<LocalizationError> errors_of(const std::vector<BeliefSample>& beliefs,
                                         const TruthTrack& truth) {
  std::map<double, LocalizationError> errors;
  for (const BeliefSample& belief : beliefs) {
    const std::optional<Pose2> pose = truth.at(belief.stamp_s);
    if (!pose) {
      continue;
    }
    LocalizationError error;
    error.belief = belief;
    error.T_world_robot = *pose;
    error.distance_m = norm(belief.T_map_robot.position() - pose->position());
    error.heading_is_right = std::abs(wrap_angle(belief.T_map_robot.yaw - pose->yaw)) < kPi / 4.0;
    errors[belief.stamp_s] = error;
  }
  std::vector<LocalizationError> in_order;
  for (const auto& entry : errors) {
    in_order.push_back(entry.second);
  }
  return in_order;
}

ErrorSummary summary_of(const std::vector<LocalizationError>& errors) {
  if (errors.empty()) {
    throw std::invalid_argument("no belief of a moment whose ground truth is known");
  }
  ErrorSummary summary;
  summary.beliefs = errors.size();
  summary.duration_s = since_start(errors, errors.back());
  std::vector<double> distances;
  std::size_t right = 0;
  std::size_t converged = 0;
  std::size_t converged_and_right = 0;
  for (const LocalizationError& error : errors) {
    distances.push_back(error.distance_m);
    right += error.is_right();
    if (!error.belief.converged) {
      continue;
    }
    ++converged;
    if (!summary.first_converged_s) {
      summary.first_converged_s = since_start(errors, error);
    }
    if (error.is_right()) {
      ++converged_and_right;
      if (!summary.first_right_converged_s) {
        summary.first_right_converged_s = since_start(errors, error);
      }
    }
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  summary.median_m = *middle;
  const auto count = static_cast<double>(errors.size());
  summary.right_share = static_cast<double>(right) / count;
  summary.converged_share = static_cast<double>(converged) / count;
  if (converged > 0) {
    summary.false_share =
        static_cast<double>(converged - converged_and_right) / static_cast<double>(converged);
  }
  return summary;
}

std::string table_of(const std::vector<LocalizationError>& errors, std::size_t rows) {
  std::ostringstream text;
  text << "  time [s]  error [m]  heading  confidence  entropy [nats]  converged\n" << std::fixed;
  const std::size_t stride =
      std::max<std::size_t>(1, errors.size() / std::max<std::size_t>(1, rows));
  for (std::size_t i = 0; i < errors.size(); i += stride) {
    const LocalizationError& e = errors[i];
    text << std::setw(10) << std::setprecision(1) << since_start(errors, e) << std::setw(11)
         << std::setprecision(2) << e.distance_m << std::setw(9)
         << (e.heading_is_right ? "right" : "wrong") << std::setw(12) << e.belief.confidence
         << std::setw(16) << e.belief.entropy << std::setw(11)
         << (e.belief.converged ? "yes" : "no") << "\n";
  }
  return text.str();
}

std::string text_of(const ErrorSummary& s) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << s.beliefs << " beliefs over " << s.duration_s
       << " s\n"
       << "median error             " << s.median_m << " m\n"
       << "within 1 m, heading too  " << 100.0 * s.right_share << " %\n"
       << "converged                " << 100.0 * s.converged_share << " %, of which falsely "
       << 100.0 * s.false_share << " %\n"
       << "first converged          " << seconds_text(s.first_converged_s) << ", rightly "
       << seconds_text(s.first_right_converged_s) << "\n";
  return text.str();
}

std::string csv_of(const std::vector<LocalizationError>& errors) {
  std::ostringstream text;
  text << "stamp_s,error_m,heading_right,confidence,entropy_nats,converged,"
          "estimate_x_m,estimate_y_m,estimate_yaw_deg,truth_x_m,truth_y_m,truth_yaw_deg\n"
       << std::fixed;
  for (const LocalizationError& e : errors) {
    const BeliefSample& b = e.belief;
    text << std::setprecision(3) << b.stamp_s << "," << e.distance_m << "," << e.heading_is_right
         << "," << std::setprecision(4) << b.confidence << "," << b.entropy << "," << b.converged
         << std::setprecision(3);
    for (const Pose2& pose : {b.T_map_robot, e.T_world_robot}) {
      text << "," << pose.x << "," << pose.y << "," << pose.yaw * kDegPerRad;
    }
    text << "\n";
  }
  return text.str();
}

}  // namespace cmn
