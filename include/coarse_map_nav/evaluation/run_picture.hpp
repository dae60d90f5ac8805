// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A journey as one picture and as a short film.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/evaluation/gif.hpp"
#include "coarse_map_nav/evaluation/run_record.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// The colour of a probability (BGR), from pale yellow over red to near black: logarithmic, from
/// `p_faint` down white, at 1 the darkest.
cv::Scalar heat_colour(double probability, double p_faint);

/// The drawing with a belief on it, one pixel a cell: free cells in their heat colour, where a
/// uniform belief is pale; walls dark. Rows as in a picture, from the top down.
cv::Mat belief_cells(const CoarseMap& map, const Grid<float>& marginal);

/// 1400 pixels wide, 8-bit BGR: the world with the path driven, coloured by time, and the drawing
/// with the belief at four moments: the first, the last and two between. A moment shows the
/// estimate and, where the setting has a warp, the truth. Throws std::invalid_argument when there
/// is no moment or a belief does not fit the drawing.
cv::Mat run_picture(const RunSetting& setting, const RunRecord& record, const std::string& title,
                    const std::string& subtitle);

/// The same as a film of at most `most_frames`, the drawing beside the world; the last frame stays
/// for 3 s. `ending`: what is written on that one. Throws as run_picture().
std::vector<FilmFrame> run_film(const RunSetting& setting, const RunRecord& record,
                                const std::string& title, const std::string& ending,
                                std::size_t most_frames);

}  // namespace cmn
