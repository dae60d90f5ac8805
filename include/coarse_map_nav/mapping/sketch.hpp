// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A photo of an ink drawing, or a clean drawing -> coarse cells.
#pragma once

#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// How a drawing is read. Sizes count in cells of the result, the measure that the drawer thinks
/// in.
struct SketchParams {
  int cells = 50;
  double threshold = 0.0;
  double speck_cells = 0.4;
  double hatching_cells = 1.0;
  double passage_cells = 0.3;
  double outer_gap_cells = 2.5;

  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("cells", self.cells, Between{2, 10000}, "[cells] width of the result");
    visit("threshold", self.threshold, Between{0.0, 0.99},
          "[-] pixels darker than this share of the paper are ink; 0: found by Otsu's method");
    visit("speck_cells", self.speck_cells, Between{0.0, 5.0},
          "[cells] patches of ink with no side longer are specks or print, and removed");
    visit("hatching_cells", self.hatching_cells, Between{0.0, 10.0},
          "[cells] enclosed paper that no larger disc fits into is a gap of hatching, and filled");
    visit("passage_cells", self.passage_cells, Between{0.0, 1.0},
          "[cells] gaps between strokes that are narrower are slips of the pen, and closed");
    visit("outer_gap_cells", self.outer_gap_cells, Between{0.0, 50.0},
          "[cells] an outer wall with gaps up to this width still keeps the margin out");
  }
};

/// One step of the work, to be looked at.
struct SketchStage {
  std::string name;     ///< fit for a file name
  std::string caption;  ///< for people
  cv::Mat picture;      ///< CV_8UC1, dark = ink
};

/// A drawing that has been read.
struct Sketch {
  Grid<std::uint8_t> occupied;  ///< the cells, 1 = occupied
  std::vector<SketchStage> stages;
};

/// Reads a picture (CV_8UC1 or CV_8UC3): find the sheet, even out the light, threshold, remove
/// specks, lay straight, fill hatching, cut off all outside the outer walls, reduce to cells.
/// The result reaches one cell beyond the outermost free ones where the picture has walls there.
/// A picture of two tones is taken as it is: no sheet is sought and no light evened out.
/// Throws std::runtime_error with one sentence when no drawing is found, nothing in it is free or
/// it has fewer pixels than the cells wanted.
Sketch read_sketch(const cv::Mat& picture, const SketchParams& params);

}  // namespace cmn
