// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Panoramas and truths as tensors, predictions back from them.
#pragma once

#include "coarse_map_nav/learning/example.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <vector>

#include <ATen/ATen.h>

namespace cmn {

/// [n, 4, 3, 80, 80], red, green, blue in [0, 1].
at::Tensor panoramas_tensor(const std::vector<ColorPanorama>& panoramas);
/// [n, size, size] of the truth's bits, uint8.
at::Tensor near_tensor(const std::vector<Example>& examples);
at::Tensor wide_tensor(const std::vector<Example>& examples);

/// `square`: [2, size, size], P(occupied) and P(in sight), float.
LocalOccupancy local_occupancy(const at::Tensor& square, double side_m, double stamp_s);

}  // namespace cmn
