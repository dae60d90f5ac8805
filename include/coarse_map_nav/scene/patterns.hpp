// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Textures of floors, drawn.
#pragma once

#include <random>

#include <opencv2/core.hpp>

namespace cmn {

/// A pattern stands for a square of this side and can be repeated.
constexpr float kPatternSide_m = 2.0F;

/// Planks of one kind of wood. CV_8UC4, BGRA.
cv::Mat plank_pattern(std::mt19937_64& rng);
/// Square tiles with joints between them. CV_8UC4, BGRA.
cv::Mat tile_pattern(std::mt19937_64& rng);

}  // namespace cmn
