// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/paper_figures.hpp"

namespace cmn {

std::vector<PaperFigure> paper_figures(const std::string& task) {
  if (task == "CG") {
    return {{"cmn", {{{94.7, 58.0}, {95.7, 57.3}, {83.8, 51.9}}}},
            {"rmn", {{{70.4, 33.4}, {63.0, 29.1}, {57.8, 26.2}}}}};
  }
  if (task == "CI") {
    return {{"cmn", {{{91.6, 50.7}, {87.8, 51.2}, {70.0, 37.7}}}},
            {"mcse", {{{78.9, 28.4}, {76.9, 28.8}, {70.0, 30.4}}}},
            {"rmn", {{{53.3, 45.8}, {54.1, 11.4}, {49.3, 11.3}}}},
            {"rnd", {{{10.7, 9.5}, {10.7, 9.5}, {10.7, 9.5}}}}};
  }
  return {};
}

}  // namespace cmn
