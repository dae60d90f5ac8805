// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The files inside a zip archive, by libzip.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace cmn {

class ZipArchive {
 public:
  /// Throws std::runtime_error, naming the file, when it is no zip archive.
  explicit ZipArchive(const std::string& path);

  const std::string& path() const { return path_; }
  bool contains(const std::string& file) const;
  /// The bytes of a file; empty when there is no such file, it is broken, or above 256 MB.
  std::vector<std::uint8_t> read(const std::string& file) const;

 private:
  struct Close {
    void operator()(zip* archive) const;
  };
  std::string path_;
  std::unique_ptr<zip, Close> archive_;
};

}  // namespace cmn
