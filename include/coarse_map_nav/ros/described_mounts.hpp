// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The parameter robot_description -> where the sensors are.
#pragma once

#include "coarse_map_nav/simulation/robot_description.hpp"

#include <string>

namespace cmn {

/// From the parameter that robot_state_publisher reads too, sought as it does: in the namespace of
/// the node, then further out. Throws std::runtime_error when there is none, and as mounts_of().
SensorMounts described_mounts(const std::string& base, const SensorFrameParams& frames);

}  // namespace cmn
