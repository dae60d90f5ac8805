// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/localizer.hpp"

#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/localization/particle_filter.hpp"
#include "coarse_map_nav/localization/range_looks.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cmn {

Pose2 pose_in_map(const CoarseMap& map, const Localization& localization) {
  const Point2 p = map.resolution() * localization.position_cells;
  return map.T_map_grid() * Pose2{p.x, p.y, localization.yaw_rad};
}

double weight_near(const Pose2& T_map_robot, double position_sigma_m, double yaw_sigma_rad,
                   const CoarseMap& map, double yaw_rad, Cell cell) {
  const double sigma_m = std::max(position_sigma_m, 0.5 * map.resolution());
  const double off = norm(map.center_of(cell) - T_map_robot.position()) / sigma_m;
  const double off_yaw =
      wrap_angle(yaw_rad + map.T_map_grid().yaw - T_map_robot.yaw) / std::max(yaw_sigma_rad, 0.1);
  return off > 5.0 ? 0.0 : std::exp(-0.5 * (off * off + off_yaw * off_yaw));
}

std::unique_ptr<Localizer> make_localizer(const CoarseMap& map, const LocalizationParams& params) {
  if (params.filter == "discrete") {
    return std::make_unique<BeliefFilter>(map, params);
  }
  if (params.filter == "particle") {
    return std::make_unique<ParticleFilter>(map, params);
  }
  if (params.filter == "scaled") {
    return std::make_unique<ScaleFilter>(map, params.scaled, params.converged_confidence);
  }
  throw std::invalid_argument("localization filter \"" + params.filter +
                              "\" is none of discrete, particle, scaled");
}

std::unique_ptr<ExpectedLooks> make_expected_looks(const CoarseMap& map,
                                                   const LocalizationParams& params) {
  return params.filter == "scaled"
             ? std::make_unique<RangeLooks>(std::make_shared<RangeModel>(map, params.scaled),
                                            params.scaled)
             : nullptr;
}

}  // namespace cmn
