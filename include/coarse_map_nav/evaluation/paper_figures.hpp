// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the CMN paper reports, to be laid beside our own figures.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace cmn {

/// SR and SPL in per cent.
struct SuccessAndSpl {
  double success_percent;
  double spl_percent;
};

/// The resolutions of the paper's coarse-grid maps [m/cell].
constexpr std::array<double, 3> kPaperMpps{0.3, 0.4, 0.5};

/// A method of the paper on one task.
struct PaperFigure {
  std::string method;                    ///< as EpisodeKey names it
  std::array<SuccessAndSpl, 3> at_mpps;  ///< at kPaperMpps
};

/// Tables II and III of Xu, Amato and Wong, "Robot Navigation in Unseen Environments using Coarse
/// Maps": tasks CI and CG, on Gibson houses. Empty for other tasks.
std::vector<PaperFigure> paper_figures(const std::string& task);

}  // namespace cmn
