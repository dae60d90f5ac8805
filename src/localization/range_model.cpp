// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/range_model.hpp"

#include <cmath>

namespace cmn {

RangeModel::RangeModel(const CoarseMap& map, const ScaleFilterParams& params)
    : parts{map, params.part_m, params.most_parts}, table{parts.map(), code} {
  for (int error = -255; error <= 255; ++error) {
    const double share = code.step() * error / params.range_sigma;
    const double match = std::exp(-0.5 * share * share);
    // Shorter than expected: clutter; and where nothing was hit, all that one can say.
    const double hit = match + (error < 0 ? params.range_short : 0.0);
    const double free = error < 0 ? 1.0 + params.range_short : match;
    log_of_hit.push_back(static_cast<float>(std::log(hit + params.range_random)));
    log_of_free.push_back(static_cast<float>(std::log(free + params.range_random)));
  }
}

}  // namespace cmn
