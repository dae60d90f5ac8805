// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Networks in files of TorchScript, ours or anybody's.
///
/// A file's `forward` takes one tensor, float [1, 4, 3, 80, 80]: views front, left, back, right as
/// ColorPanorama has them; red, green, blue in [0, 1]; rows from the top. It returns `near`, float
/// [1, 1 or 2, 128, 128], or the pair (near, wide), wide [1, 1 or 2, 64, 64]. Channel 0 is
/// P(occupied), channel 1, if there, P(in sight), both in [0, 1]. Rows of both run to the robot's
/// left and columns forward: near[0, 0, iy, ix] is cell (ix, iy) of LocalOccupancy.
#pragma once

#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace cmn {

/// How a file is run.
struct PredictorOptions {
  int threads = 1;        ///< of torch, for the whole process
  bool is_frozen = true;  ///< weights become constants that are folded into each other; faster
};

/// Loads a file, weights of any precision as float, and runs it until its speed is steady.
///
/// Throws std::runtime_error naming the file and what is wrong: absent, no TorchScript, another
/// signature, shapes or values out of range; or, when the package was built without LibTorch, what
/// to install.
std::unique_ptr<OccupancyPredictor> load_predictor(const std::string& path,
                                                   const PredictorOptions& options = {});

/// Writes a network ("wedge" or "cmn") with weights drawn from a seed: for tests and benchmarks.
/// `is_half`: weights are stored in 16 bits. Throws std::runtime_error when it cannot.
void write_untrained_model(const std::string& path, const std::string& network, std::uint64_t seed,
                           bool is_half);

}  // namespace cmn
