// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Files of a fuzzer's own, for readers that take a path.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace cmn {

/// A folder that lasts as long as the process.
class FuzzFolder {
 public:
  FuzzFolder()
      : path_{std::filesystem::temp_directory_path() / ("cmn_fuzz_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(path_);
  }
  ~FuzzFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Returns the path.
  std::string write(const std::string& name, const std::string& content) const {
    const std::string path = path_ / name;
    std::ofstream{path, std::ios::binary} << content;
    return path;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace cmn
