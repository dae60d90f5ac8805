// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Houses as an architect would draw them, seen from above.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// One house with the names of rooms and furniture (CV_8UC3).
cv::Mat house_picture(const House& house, double pixels_per_metre = 80.0);

/// Many on one page, all at the same scale, each with its title and the names of its rooms; what
/// the colours of the furniture mean stands below (CV_8UC3).
cv::Mat house_sheet(const std::vector<House>& houses, const std::vector<std::string>& titles,
                    double pixels_per_metre = 23.0, int width_px = 1800);

}  // namespace cmn
