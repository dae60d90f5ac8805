// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small files for the tests of readers, and the data that may or may not be there.
#pragma once

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace cmn {

/// Writes a file into the tests' own folder, named after the running test; returns its path.
inline std::string file_with(const std::string& name, const std::string& content) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string path =
      ::testing::TempDir() + test->test_suite_name() + "_" + test->name() + "_" + name;
  std::ofstream{path, std::ios::binary} << content;
  return path;
}

/// The text of the std::runtime_error that `action` throws; "" when it throws none.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

/// A file of the data that is not part of the package: in $CMN_DATA_DIR, else beside the package.
inline std::string data_file(const std::string& name) {
  const char* folder = std::getenv("CMN_DATA_DIR");
  return (folder != nullptr ? std::string{folder} : CMN_SOURCE_DIR "/../shared/data") + "/" + name;
}
inline bool exists(const std::string& path) { return std::ifstream{path}.good(); }

}  // namespace cmn

/// Skips the running test when a data file is absent.
#define CMN_NEEDS_DATA(path)                                                            \
  if (!::cmn::exists(path)) {                                                           \
    GTEST_SKIP() << (path) << " is absent; set CMN_DATA_DIR to the folder that has it"; \
  }
