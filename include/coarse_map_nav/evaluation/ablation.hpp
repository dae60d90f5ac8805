// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Methods with one part changed, beside the whole.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/evaluation/episode_group.hpp"

#include <map>
#include <string>
#include <vector>

namespace cmn {

/// Changes of a preset by the name of the variant: "no_range_model" -> its parameters.
using Variants = std::map<std::string, ParamTree>;

/// Reads a file of variants, each a group of parameters as in a preset. Throws std::runtime_error
/// naming the file and what is no variant in it.
Variants read_variants(const std::string& path);

/// A row for each variant METHOD+VARIANT whose METHOD is there too: SR, SPL, declarations, false
/// convergence, and the differences to METHOD on the episodes that both have run, with paired 95 %
/// intervals; empty when there is none.
std::string ablation_table(const EpisodeTable& table);

/// Those differences in SR and SPL, of one task, a row of panels for each resolution. Empty
/// likewise.
std::string ablation_plot(const std::vector<EpisodeTable>& tables);

}  // namespace cmn
