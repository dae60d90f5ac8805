// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Examples and predictions to look at.
#pragma once

#include "coarse_map_nav/learning/example.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// A line of a sheet: what is not there is left out.
struct SheetRow {
  ColorPanorama panorama;
  std::optional<Example> truth;
  std::optional<PredictedOccupancy> predicted;
};

/// CV_8UC3: the left, front, right and back view, then the near and the wide square, first as they
/// are, then as predicted. Squares have forward up and the left to the left, like the views; white
/// is free, black occupied, the more yellow the less in sight.
cv::Mat example_sheet(const std::vector<SheetRow>& rows);

}  // namespace cmn
