// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One moment of an episode taken apart: what each part of the navigator made of the same look.
#pragma once

#include "coarse_map_nav/evaluation/judged_episode.hpp"
#include "coarse_map_nav/params.hpp"

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

struct ExplanationPanel {
  std::string name;  ///< of a file: "look", "range_model", ...
  cv::Mat picture;   ///< 8-bit BGR
};

/// What there is to see of a method with these parameters:
///  - "look": the local occupancy that was believed from, with the rays cast through it;
///  - "range_model", "likelihood_field", "one_look": what this look alone says of a robot that may
///    be anywhere, by one part of the scaled filter's model, the other, and both;
///  - "belief": all looks together;
///  - "scales": how the belief is spread over the scales, against `true_scale`;
///  - "lattice": what the robot can drive to through what it sees, by cost;
///  - "repaired_map": what was learned about the drawing.
std::vector<ExplanationPanel> explain(const EpisodeMoment& moment, const NavigatorParams& params,
                                      double true_scale);

/// The panels in rows of three under a title and a line of text.
cv::Mat explanation_sheet(const std::vector<ExplanationPanel>& panels, const std::string& title,
                          const std::string& text);

}  // namespace cmn
