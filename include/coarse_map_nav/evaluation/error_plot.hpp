// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Pictures of a run's localization error.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/evaluation/localization_error.hpp"

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// Error and confidence over time (8-bit BGR), shaded while the filter says it has converged: green
/// where it is right, red where it is not. `errors` must not be empty.
cv::Mat error_plot(const std::vector<LocalizationError>& errors, const std::string& title);

/// The map with the true path (grey line) and the estimates of a converged filter on it: green
/// where right, red where not.
cv::Mat track_plot(const std::vector<LocalizationError>& errors, const CoarseMap& map);

}  // namespace cmn
