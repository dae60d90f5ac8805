// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the models of a Gazebo world lie.
#pragma once

#include <string>
#include <vector>

namespace cmn {

/// The folders that hold models for a world: the world's own, its parent, the `models` in either,
/// $GAZEBO_MODEL_PATH, and in $CMN_DATA_DIR every folder's `models`. Only such as are there.
std::vector<std::string> model_folders(const std::string& world);

/// The file or folder that a URI names: model://NAME[/FILE] in the first of `folders` that has it,
/// file://PATH, or a path, relative to `folder`. Empty when there is none.
std::string find_uri(const std::string& uri, const std::string& folder,
                     const std::vector<std::string>& folders);

/// Follows all includes of a world, those of included files too, and returns the URIs that lead
/// nowhere. Throws std::runtime_error when a file includes itself over any number of others, or
/// when they come to more than 20000 files, each counted as often as it is included: a reader would
/// not come to an end.
std::vector<std::string> check_includes(const std::string& world,
                                        const std::vector<std::string>& folders);

}  // namespace cmn
