// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How likely a range is, by the range that the drawing makes one expect.
#pragma once

#include "coarse_map_nav/localization/map_parts.hpp"
#include "coarse_map_nav/localization/range_table.hpp"
#include "coarse_map_nav/localization/scale_filter_params.hpp"

#include <vector>

namespace cmn {

/// What a ScaleFilter knows of a drawing's ranges before the first look.
struct RangeModel {
  RangeModel(const CoarseMap& map, const ScaleFilterParams& params);

  MapParts parts;
  LogRange code;
  RangeTable table;  ///< of the parts
  /// Log likelihood of a ray by the error of its coded range, from -255 on: of one that ended at
  /// something, of one that did not.
  std::vector<float> log_of_hit;
  std::vector<float> log_of_free;
};

}  // namespace cmn
