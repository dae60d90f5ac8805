// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the main() of every command line tool does.
#pragma once

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>

namespace cmn {

/// Runs a tool: its exit status, or 1 and one line on stderr for what it throws.
inline int tool_main(int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << std::filesystem::path{argv[0]}.filename().string() << ": " << e.what() << "\n";
    return EXIT_FAILURE;
  }
}

}  // namespace cmn
