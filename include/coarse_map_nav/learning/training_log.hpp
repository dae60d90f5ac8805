// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a training came to, epoch by epoch, as a table and as a picture.
#pragma once

#include "coarse_map_nav/learning/training.hpp"

#include <string>
#include <vector>

namespace cmn {

/// CSV with a header; numbers that are not there are empty.
std::string training_csv(const std::vector<EpochRow>& rows);

/// Losses of training and validation over the epochs, and beside them average precision, IoU and
/// calibration error on the validation examples. An SVG; `rows` must not be empty.
std::string training_plot(const std::vector<EpochRow>& rows, const std::string& title);

}  // namespace cmn
