// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/coarsen.hpp"

#include "coarse_map_nav/mapping/cell_choice.hpp"
#include "coarse_map_nav/mapping/free_pieces.hpp"
#include "coarse_map_nav/mapping/image_reader.hpp"

#include <stdexcept>
#include <string>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// Occupies free space that a disc of the diameter does not fit into.
Grid<std::uint8_t> sealed(const Grid<std::uint8_t>& occupied, double diameter_px) {
  const int side = 2 * static_cast<int>(diameter_px / 2.0) + 1;
  if (side < 3) {
    return occupied;
  }
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
  cv::Mat closed;
  cv::morphologyEx(image_of(occupied), closed, cv::MORPH_CLOSE, disc);
  return grid_of(closed);
}

}  // namespace

Grid<std::uint8_t> coarsen(const Grid<std::uint8_t>& occupied, double pixels_per_cell,
                           double narrowest_passage_cells) {
  if (!(pixels_per_cell >= 1.0)) {
    throw std::invalid_argument("a cell must be at least one pixel wide");
  }
  const Grid<std::uint8_t> fine = sealed(occupied, narrowest_passage_cells * pixels_per_cell);
  const FreePieces pieces{fine, pixels_per_cell};
  CellChoice choice{pieces};
  choice.vote();
  choice.keep_walls();
  choice.keep_doors();
  choice.join_rooms();
  choice.keep_obstacles(fine, pixels_per_cell);
  choice.fill_pockets();
  return choice.occupied();
}

CoarseMap coarsen(const CoarseMap& fine, int cells_wide) {
  if (cells_wide < 1 || cells_wide > fine.width()) {
    throw std::invalid_argument("a map of " + std::to_string(fine.width()) +
                                " cells width cannot be reduced to " + std::to_string(cells_wide));
  }
  const double pixels_per_cell = static_cast<double>(fine.width()) / cells_wide;
  return {coarsen(fine.occupied(), pixels_per_cell), fine.resolution() * pixels_per_cell,
          fine.T_map_grid()};
}

}  // namespace cmn
