// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/image_reader.hpp"

#include <fstream>
#include <stdexcept>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// Whether the file begins as every JPEG does. Only a JPEG needs OpenCV's colour reading, which
/// follows the EXIF orientation; it has neither alpha nor 16 bit, which that reading would lose.
bool is_jpeg(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  if (!file) {
    throw std::runtime_error(path + ": cannot be opened; is the path right and readable?");
  }
  return file.get() == 0xFF && file.get() == 0xD8;
}

/// 8 bit, channels as in the file.
cv::Mat read_pixels(const std::string& path) {
  const int flags = is_jpeg(path) ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED;
  cv::Mat pixels;
  try {
    pixels = cv::imread(path, flags);
  } catch (const cv::Exception& e) {
    throw std::runtime_error(path + ": cannot be read as an image: " + e.err);
  }
  if (pixels.empty()) {
    throw std::runtime_error(path +
                             ": is not an image that can be read (PNG, JPEG, PGM, BMP, TIFF)");
  }
  if (pixels.depth() == CV_16U) {
    cv::Mat narrow;
    pixels.convertTo(narrow, CV_8U, 1.0 / 257.0);
    return narrow;
  }
  if (pixels.depth() != CV_8U) {
    throw std::runtime_error(path +
                             ": has pixels of neither 8 nor 16 bit; save it as an 8 bit PNG");
  }
  return pixels;
}

/// The colours without alpha, laid over white: a transparent pixel is blank paper.
cv::Mat over_white(const cv::Mat& pixels, cv::Mat& transparent) {
  std::vector<cv::Mat> channels;
  cv::split(pixels, channels);
  if (channels.size() != 2 && channels.size() != 4) {
    return pixels;
  }
  const cv::Mat alpha = channels.back();
  channels.pop_back();
  cv::compare(alpha, 255, transparent, cv::CMP_LT);
  for (cv::Mat& channel : channels) {
    cv::Mat shade;
    cv::multiply(255 - channel, alpha, shade, 1.0 / 255.0);
    channel = 255 - shade;
  }
  cv::Mat colours;
  cv::merge(channels, colours);
  return colours;
}

}  // namespace

Image read_image(const std::string& path) {
  Image image;
  const cv::Mat colours = over_white(read_pixels(path), image.transparent);
  if (colours.channels() == 1) {
    image.gray = colours;
  } else {
    cv::transform(colours, image.gray, cv::Matx13f::all(1.0F / 3.0F));
  }
  return image;
}

cv::Mat read_colour_image(const std::string& path) {
  cv::Mat transparent;
  const cv::Mat colours = over_white(read_pixels(path), transparent);
  if (colours.channels() == 3) {
    return colours;
  }
  cv::Mat bgr;
  cv::cvtColor(colours, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

Grid<std::uint8_t> grid_of(const cv::Mat& occupied) {
  Grid<std::uint8_t> grid{occupied.cols, occupied.rows};
  for (int row = 0; row < occupied.rows; ++row) {
    const std::uint8_t* pixel = occupied.ptr<std::uint8_t>(row);
    std::size_t i = grid.index_of({0, occupied.rows - 1 - row});
    for (int column = 0; column < occupied.cols; ++column) {
      grid[i++] = pixel[column] != 0;
    }
  }
  return grid;
}

cv::Mat image_of(const Grid<std::uint8_t>& occupied) {
  cv::Mat image(occupied.height(), occupied.width(), CV_8UC1);
  for (int row = 0; row < image.rows; ++row) {
    std::uint8_t* pixel = image.ptr<std::uint8_t>(row);
    for (int column = 0; column < image.cols; ++column) {
      pixel[column] = occupied({column, image.rows - 1 - row}) != 0 ? 255 : 0;
    }
  }
  return image;
}

}  // namespace cmn
