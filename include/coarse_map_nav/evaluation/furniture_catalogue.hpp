// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Pieces of furniture as boxes and cylinders, in usual sizes.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"

#include <string>

namespace cmn {

/// A solid block from `elevation_m` up. `is_round`: an upright cylinder instead.
Furniture block(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m,
                double size_z_m, double elevation_m = 0.0, bool is_round = false);
/// A top on four legs; nothing between them.
Furniture table(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m,
                double size_z_m = 0.74);
/// A low table with a shelf at 0.15 m, so that it shows in the plane of a low LiDAR.
Furniture coffee_table(const Pose2& pose, double size_x_m, double size_y_m);
/// A top between two side panels.
Furniture desk(const Pose2& pose, double size_x_m, double size_y_m);
/// 0.44 m square, on four legs, with a back.
Furniture chair(const Pose2& pose);
Furniture office_chair(const Pose2& pose);
/// Of any width: an armchair is a narrow one.
Furniture sofa(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m);
/// Its head is at its back.
Furniture bed(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m);
Furniture toilet(const Pose2& pose);

}  // namespace cmn
