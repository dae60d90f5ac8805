// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/sketch.hpp"

#include "coarse_map_nav/mapping/coarsen.hpp"
#include "coarse_map_nav/mapping/frame.hpp"
#include "coarse_map_nav/mapping/image_reader.hpp"
#include "coarse_map_nav/mapping/ink.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr int kPixelsPerCell = 32;  ///< more than that tells nothing about a cell

/// Grey, and no larger than of use.
cv::Mat reduced(const cv::Mat& picture, int cells) {
  cv::Mat gray = picture;
  if (picture.channels() == 3) {
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  }
  const double scale = static_cast<double>(kPixelsPerCell) * cells / gray.cols;
  if (scale < 0.75) {
    cv::Mat small;
    cv::resize(gray, small, {}, scale, scale, cv::INTER_AREA);
    return small;
  }
  return gray;
}

/// The part of the drawing that becomes cells, and the size of one.
struct Crop {
  cv::Rect2d box;  ///< [px], may reach beyond the picture
  double pixels_per_cell;
};

/// The bounds of the free pixels and up to one cell of wall on each side, divided into cells.
Crop find_crop(const cv::Mat& occupied, int cells) {
  const cv::Rect free = cv::boundingRect(255 - occupied);
  Crop crop{{}, static_cast<double>(occupied.cols) / cells};
  for (int round = 0; round < 20; ++round) {  // the wall is one cell, the cell depends on the wall
    const double cell = crop.pixels_per_cell;
    const double left = std::min<double>(free.x, cell);
    const double top = std::min<double>(free.y, cell);
    const double right = std::min<double>(occupied.cols - free.br().x, cell);
    const double bottom = std::min<double>(occupied.rows - free.br().y, cell);
    crop.box = {free.x - left, free.y - top, free.width + left + right, free.height + top + bottom};
    crop.pixels_per_cell = crop.box.width / cells;
  }
  return crop;
}

class Reader {
 public:
  Reader(const cv::Mat& picture, const SketchParams& params)
      : params_{params}, gray_{reduced(picture, params.cells)} {
    cell_px_ = std::max(1.0, static_cast<double>(gray_.cols) / params.cells);
  }

  Sketch read() {
    keep("input", "as photographed", gray_);
    const cv::Mat ink = find_ink();
    const cv::Mat straight = lay_straight(ink);
    reduce(cut_out(straight));
    return std::move(sketch_);
  }

 private:
  void keep(const std::string& name, const std::string& caption, const cv::Mat& picture) {
    const std::string number = std::to_string(sketch_.stages.size());
    sketch_.stages.push_back({number + "_" + name, number + ". " + caption, picture.clone()});
  }

  cv::Mat find_ink() {
    if (is_binary(gray_)) {
      const cv::Mat ink = threshold_ink(gray_, params_.threshold > 0.0 ? params_.threshold : 0.5);
      keep("ink", "ink (two tones: taken as it is)", 255 - ink);
      return ink;
    }
    const cv::Mat flat = flatten_light(gray_);
    keep("light", "light evened out", flat);
    cv::Mat sheet = flat.clone();
    sheet.setTo(255, find_sheet(flat) == 0);
    keep("sheet", "the sheet alone", sheet);
    const cv::Mat ink = threshold_ink(sheet, params_.threshold);
    keep("ink", "ink", 255 - ink);
    const cv::Mat clean = remove_specks(ink, params_.speck_cells * cell_px_);
    keep("clean", "without specks and print", 255 - clean);
    return clean;
  }

  /// The drawing alone, straight, with a rim of paper where the picture has paper there.
  cv::Mat lay_straight(const cv::Mat& ink) {
    const Straightened straight = straighten(ink, find_drawing_in(ink));
    const cv::Rect drawing = find_drawing_in(straight.ink);
    const cv::Rect with_rim{drawing.tl() - cv::Point{2, 2}, drawing.size() + cv::Size{4, 4}};
    const cv::Mat alone = straight.ink(with_rim & cv::Rect{{0, 0}, ink.size()}).clone();
    keep("straight", "laid straight: " + straight.how, 255 - alone);
    return alone;
  }

  cv::Rect find_drawing_in(const cv::Mat& ink) const {
    const cv::Rect drawing = find_drawing(ink, params_.outer_gap_cells * cell_px_ / 2.0);
    if (drawing.area() == 0) {
      throw std::runtime_error(
          "no drawing is found in the picture; is it dark ink on light paper?");
    }
    return drawing;
  }

  /// Occupied pixels of the drawing: hatching filled, nothing free outside.
  cv::Mat cut_out(const cv::Mat& ink) {
    cv::Mat occupied = ink | find_outside(ink, params_.outer_gap_cells * cell_px_);
    occupied = fill_hatching(occupied, params_.hatching_cells * cell_px_);
    if (cv::countNonZero(255 - occupied) == 0) {
      throw std::runtime_error("nothing in the drawing is free; is the threshold right?");
    }
    keep("inside", "hatching filled, cut out", 255 - occupied);
    return occupied;
  }

  void reduce(const cv::Mat& occupied) {
    const Crop crop = find_crop(occupied, params_.cells);
    if (crop.pixels_per_cell < 1.0) {
      throw std::runtime_error("the drawing is only " +
                               std::to_string(std::lround(crop.box.width)) +
                               " pixels wide, less than the " + std::to_string(params_.cells) +
                               " cells wanted; ask for fewer cells");
    }
    const cv::Rect whole{cv::Point{static_cast<int>(std::lround(crop.box.x)),
                                   static_cast<int>(std::lround(crop.box.y))},
                         cv::Size{static_cast<int>(std::lround(crop.box.width)),
                                  static_cast<int>(std::lround(crop.box.height))}};
    const cv::Mat inside = occupied(whole & cv::Rect{{0, 0}, occupied.size()});
    sketch_.occupied = coarsen(grid_of(inside), static_cast<double>(inside.cols) / params_.cells,
                               params_.passage_cells);
    keep("cells", "cells", 255 - image_of(sketch_.occupied));
  }

  const SketchParams& params_;
  cv::Mat gray_;
  double cell_px_ = 1.0;
  Sketch sketch_;
};

}  // namespace

Sketch read_sketch(const cv::Mat& picture, const SketchParams& params) {
  if (picture.empty()) {
    throw std::runtime_error("the picture is empty");
  }
  return Reader{picture, params}.read();
}

}  // namespace cmn
