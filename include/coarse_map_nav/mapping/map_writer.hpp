// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// CoarseMap -> files that map_server, rviz and read_map can read.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

#include <string>

namespace cmn {

/// Writes NAME.yaml in map_server's format and NAME.png beside it: one pixel a cell, free white,
/// occupied black. Reading it back gives the same map. `yaml_path` must end in .yaml; the folder
/// must exist. Throws std::runtime_error, naming the file that cannot be written.
void write_map(const std::string& yaml_path, const CoarseMap& map);

}  // namespace cmn
