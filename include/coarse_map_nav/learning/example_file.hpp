// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The examples of one house in a file of HDF5, which h5py and MATLAB read as well.
///
///     attribute "format"      "coarse_map_nav examples 1"
///     attribute "house_seed"  uint32
///     panorama  uint8   [n][view: front, left, back, right][row][column][blue, green, red]
///     near      uint8   [n][128: y to the left][128: x forward], bit 0 occupied, bit 1 seen
///     wide      uint8   [n][64][64], likewise
///     camera    float32 [n][height m, tilt downwards rad, horizontal field of view rad]
#pragma once

#include "coarse_map_nav/learning/example.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cmn {

/// Writes a file as a whole or not at all: it has another name until it is finished. Throws
/// std::runtime_error naming the path.
void write_examples(const std::string& path, std::uint32_t house_seed,
                    const std::vector<Example>& examples);

/// A file that is read example by example.
class ExampleFile {
 public:
  /// Throws std::runtime_error naming the file and what is wrong: absent, no HDF5, cut off, of
  /// another format or of other sizes.
  explicit ExampleFile(const std::string& path);
  ExampleFile(ExampleFile&&) noexcept;
  ExampleFile& operator=(ExampleFile&&) noexcept;
  ~ExampleFile();

  std::uint32_t house_seed() const;
  std::size_t size() const;
  /// Throws std::runtime_error when the file cannot be read there. index < size().
  Example read(std::size_t index) const;

 private:
  struct Hdf5;
  std::unique_ptr<Hdf5> hdf5_;
};

}  // namespace cmn
