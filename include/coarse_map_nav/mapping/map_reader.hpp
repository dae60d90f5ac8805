// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Files -> CoarseMap. The only place where image rows (downwards) become cells (upwards).
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

#include <string>

namespace cmn {

/// Reads a coarse map, by the ending of its name:
///   .yaml      map_server (image, resolution, origin, negate, occupied_thresh, free_thresh, mode)
///   .npy       a numpy array of 2 dimensions, 1 = occupied (CMN's own files)
///   otherwise  an image, one cell a pixel: dark = occupied
/// `resolution` [m/cell] is for files that do not say; unknown cells (between the thresholds)
/// become occupied. Throws std::runtime_error with one sentence that names the file, what is wrong
/// with it (cell, key) and the remedy; a map without any free cell is such an error.
CoarseMap read_map(const std::string& path, double resolution = 0.4);

}  // namespace cmn
