// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Short films as animated GIF: small, and every browser plays them.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// One picture (8-bit BGR) and how long it is shown.
struct FilmFrame {
  cv::Mat picture;
  double duration_s = 0.1;
};

/// Writes an endlessly repeated GIF. All frames share one palette, the 255 colours most used; of a
/// frame only what differs from the one before is stored. Throws std::invalid_argument for frames
/// that are none, not 8-bit BGR or of different sizes, std::runtime_error naming the file when it
/// cannot be written.
void write_gif(const std::string& path, const std::vector<FilmFrame>& frames);

}  // namespace cmn
