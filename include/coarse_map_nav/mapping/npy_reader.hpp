// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// numpy's .npy files.
#pragma once

#include "coarse_map_nav/data/grid.hpp"

#include <string>

namespace cmn {

/// Reads a little-endian numpy array of 2 dimensions (f4 f8, i1 to i8, u1 to u8, b1; C or Fortran
/// order; format versions 1 to 3). Row 0 of the array is the top of the map, as in an image, and
/// becomes the highest row of cells. Throws std::runtime_error, naming the file and what is wrong.
/// Format: numpy.lib.format, "Format Version 1.0" to "3.0".
Grid<double> read_npy(const std::string& path);

}  // namespace cmn
