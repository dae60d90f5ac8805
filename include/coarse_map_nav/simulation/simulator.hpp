// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A planar world, a Kobuki-like base in it and a LiDAR on the base.
#pragma once

#include <cstdint>
#include <random>

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/motion/motion_controller.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

namespace cmn {
// Owner of this file: simulation. See the components it composes: world.hpp, robot_model.hpp,
// range_sensor.hpp.
}  // namespace cmn
