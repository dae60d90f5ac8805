// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_set.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <filesystem>
#include <numeric>
#include <random>
#include <stdexcept>

namespace cmn {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOpen = 400;  ///< a process has 1024 files by default

constexpr std::array<Split, 3> kSplits{Split::kTrain, Split::kValidation, Split::kTest};

std::vector<std::string> example_files(const std::string& folder) {
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(folder + ": is no folder of examples");
  }
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator{folder}) {
    if (entry.path().extension() == ".h5") {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

const char* name(Split split) {
  switch (split) {
    case Split::kTrain:
      return "train";
    case Split::kValidation:
      return "validation";
    case Split::kTest:
      return "test";
  }
  return "";
}

Split parse_split(const std::string& word) {
  for (const Split split : kSplits) {
    if (word == name(split)) {
      return split;
    }
  }
  throw std::runtime_error("there is no split \"" + word + "\"; train, validation or test");
}

Split split_of(std::uint32_t house_seed) {
  // SplitMix64 (Steele et al. 2014): neighbouring seeds fall apart.
  std::uint64_t z = house_seed + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  z ^= z >> 31U;
  const std::uint64_t share = z % 10U;
  return share < 8U ? Split::kTrain : share == 8U ? Split::kValidation : Split::kTest;
}

ExampleSet::ExampleSet(const std::string& folder, Split split) {
  for (const std::string& path : example_files(folder)) {
    const ExampleFile file{path};
    if (split_of(file.house_seed()) != split) {
      continue;
    }
    for (std::size_t i = 0; i < file.size(); ++i) {
      places_.emplace_back(files_.size(), i);
    }
    files_.push_back({path, std::nullopt});
  }
  if (places_.empty()) {
    throw std::runtime_error(folder + ": holds no example for " + name(split) +
                             "; cmn_dataset makes them");
  }
}

const ExampleFile& ExampleSet::opened(Shard& shard) {
  if (!shard.file) {
    if (open_count_ == kMostOpen) {
      for (Shard& other : files_) {
        other.file.reset();
      }
      open_count_ = 0;
    }
    shard.file.emplace(shard.path);
    ++open_count_;
  }
  return *shard.file;
}

Example ExampleSet::read(std::size_t index) {
  assert(index < size());
  const auto& [file, example] = places_[index];
  return opened(files_[file]).read(example);
}

std::vector<std::size_t> shuffled_order(std::size_t size, std::uint64_t seed, std::uint64_t epoch) {
  std::seed_seq mixed{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                      static_cast<std::uint32_t>(epoch)};
  std::mt19937_64 rng{mixed};
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = size; i > 1; --i) {
    std::swap(order[i - 1], order[draw_index(rng, i)]);
  }
  return order;
}

}  // namespace cmn
