// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What looks are expected to tell, by the ranges that the drawing makes one expect.
#pragma once

#include "coarse_map_nav/data/expected_looks.hpp"
#include "coarse_map_nav/localization/range_model.hpp"

#include <memory>
#include <vector>

namespace cmn {

/// By the range model of a ScaleFilter. The drawing puts the ends of both rays anywhere within a
/// cell: a difference of less than that tells nothing.
class RangeLooks : public ExpectedLooks {
 public:
  /// `params`: those that the model was made with.
  RangeLooks(std::shared_ptr<const RangeModel> model, const ScaleFilterParams& params);

  std::vector<double> apart(const std::vector<GridPose>& poses, double scale) const override;

 private:
  std::shared_ptr<const RangeModel> model_;
  double reach_m_;
  double per_ray_;           ///< [rays a metre driven] that count as independent, for each
  std::vector<float> told_;  ///< by the codes of two expected ranges, the first times 256
};

}  // namespace cmn
