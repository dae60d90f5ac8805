// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The worst episodes of a run, to be looked at.
#pragma once

#include <cstddef>

#include "evaluation.hpp"

namespace cmn {

/// Of the rows of `plan.out`/episodes.csv that have the plan's tasks and resolutions, runs the
/// worst of each of its methods again and leaves `plan.out`/gallery: gallery.md, METHOD.png with
/// all of a method and ID.png of each. Throws std::runtime_error naming what cannot be done, or an
/// episode that did not come out as it did then.
void leave_gallery(const Plan& plan, std::size_t count);

}  // namespace cmn
