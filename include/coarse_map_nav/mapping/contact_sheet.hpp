// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All stages of reading a drawing on one page.
#pragma once

#include "coarse_map_nav/mapping/sketch.hpp"

#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// A page (CV_8UC3) with the stages row by row, each with its caption; small pictures are enlarged
/// without smoothing, so that cells stay squares.
cv::Mat contact_sheet(const std::vector<SketchStage>& stages, int columns = 3);

}  // namespace cmn
