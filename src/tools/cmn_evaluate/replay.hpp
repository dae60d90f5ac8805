// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Single episodes once more, to be looked at.
#pragma once

#include <string>
#include <vector>

#include "evaluation.hpp"

namespace cmn {

/// Runs episodes by their ids and leaves ID.png, ID.gif and, of several methods on one episode,
/// TASK-MPP-WORLD-INDEX.png in `plan.out`. Of the plan it takes worlds, seed, presets and judge.
/// Prints each row, and in what it differs from that in episodes.csv there, if any.
/// Throws std::runtime_error or std::invalid_argument naming what cannot be done.
void replay(const Plan& plan, const std::vector<std::string>& ids);

}  // namespace cmn
