// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What looks are expected to tell, by the ranges that the drawing makes one expect.
#pragma once

#include "coarse_map_nav/data/expected_looks.hpp"
#include "coarse_map_nav/localization/map_parts.hpp"
#include "coarse_map_nav/localization/range_table.hpp"
#include "coarse_map_nav/localization/scale_filter_params.hpp"

#include <vector>

namespace cmn {

/// By the range model of a ScaleFilter. The drawing puts the ends of both rays anywhere within a
/// cell: a difference of less than that tells nothing.
class RangeLooks : public ExpectedLooks {
 public:
  /// `parts` and their `table` are referred to; `log_of_hit`: log likelihood of a ray by the error
  /// of its coded range, from -255 on.
  RangeLooks(const MapParts& parts, const RangeTable& table, const LogRange& code,
             const ScaleFilterParams& params, const std::vector<float>& log_of_hit);
  RangeLooks(const RangeLooks&) = delete;
  RangeLooks& operator=(const RangeLooks&) = delete;
  ~RangeLooks() override = default;

  std::vector<double> apart(const std::vector<GridPose>& poses, double scale) const override;

 private:
  const MapParts& parts_;
  const RangeTable& table_;
  LogRange code_;
  double reach_m_;
  double per_ray_;           ///< [rays a metre driven] that count as independent, for each
  std::vector<float> told_;  ///< by the codes of two expected ranges, the first times 256
};

}  // namespace cmn
