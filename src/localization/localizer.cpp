// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/localizer.hpp"

#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/localization/particle_filter.hpp"

#include <stdexcept>

namespace cmn {

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

}  // namespace cmn
