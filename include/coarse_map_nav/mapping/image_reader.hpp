// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Image files -> pixels, and pixels -> cells: the flip between rows and cells has its home here.
#pragma once

#include "coarse_map_nav/data/grid.hpp"

#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

namespace cmn {

/// The pixels of an image file, 8 bit.
struct Image {
  cv::Mat gray;         ///< CV_8UC1, the mean of the colours, laid over white where transparent
  cv::Mat transparent;  ///< CV_8UC1, 255 where alpha is below 255; empty without an alpha channel
};

/// Reads any image that OpenCV can: 8 or 16 bit, grey, colour, with or without alpha; photos are
/// turned as their EXIF data says. Throws std::runtime_error, naming the file.
Image read_image(const std::string& path);

/// The same file in colour (CV_8UC3, BGR).
cv::Mat read_colour_image(const std::string& path);

/// Rows (downwards, CV_8UC1, not 0 = occupied) -> cells (upwards, 1 = occupied).
Grid<std::uint8_t> grid_of(const cv::Mat& occupied);

/// Cells (upwards, not 0 = occupied) -> rows (downwards, CV_8UC1, 255 = occupied).
cv::Mat image_of(const Grid<std::uint8_t>& occupied);

}  // namespace cmn
