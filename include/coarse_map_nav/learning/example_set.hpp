// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A folder of example files, parted by house into what is trained on and what is not.
#pragma once

#include "coarse_map_nav/learning/example_file.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

/// What an example is for.
enum class Split { kTrain, kValidation, kTest };
const char* name(Split split);
/// Throws std::runtime_error listing the known ones.
Split parse_split(const std::string& word);

/// Of a house, by a hash of its seed: 80 % train, 10 % validation, 10 % test. A house is in one of
/// them whatever else the folder holds.
Split split_of(std::uint32_t house_seed);

/// What stands for the seed of a world that no generator has made; a test split's.
constexpr std::uint32_t kForeignWorld = 0xfffffff7U;

/// The examples of one split of a folder, in the order of the files' names.
class ExampleSet {
 public:
  /// Throws std::runtime_error naming the folder or the file that cannot be read, or when the split
  /// is empty.
  ExampleSet(const std::string& folder, Split split);

  std::size_t size() const { return places_.size(); }
  std::size_t house_count() const { return files_.size(); }
  Example read(std::size_t index);

 private:
  /// A file, open or not: a process may not hold thousands of them.
  struct Shard {
    std::string path;
    std::optional<ExampleFile> file;
  };
  const ExampleFile& opened(Shard& shard);

  std::vector<Shard> files_;
  std::size_t open_count_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  ///< file, example
};

/// A permutation of {0 .. size - 1}; the same for the same seed and epoch everywhere.
std::vector<std::size_t> shuffled_order(std::size_t size, std::uint64_t seed, std::uint64_t epoch);

}  // namespace cmn
