// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/confidence_bins.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace cmn {

void ConfidenceBins::add(double confidence, bool is_right) {
  const auto above = std::upper_bound(kEdges.begin() + 1, kEdges.end() - 1, confidence);
  Bin& bin = bins_[static_cast<std::size_t>(above - kEdges.begin()) - 1];
  ++bin.looks;
  bin.right += is_right;
  bin.stated += confidence;
}

void ConfidenceBins::add(const ConfidenceBins& other) {
  for (std::size_t i = 0; i < kCount; ++i) {
    bins_[i].looks += other.bins_[i].looks;
    bins_[i].right += other.bins_[i].right;
    bins_[i].stated += other.bins_[i].stated;
  }
}

int ConfidenceBins::looks() const {
  int looks = 0;
  for (const Bin& bin : bins_) {
    looks += bin.looks;
  }
  return looks;
}

std::string ConfidenceBins::text() const {
  std::string text;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (bins_[i].looks > 0) {
      std::array<char, 64> bin{};
      std::snprintf(bin.data(), bin.size(), "%zu:%d:%d:%.3f", i, bins_[i].looks, bins_[i].right,
                    bins_[i].stated);
      text += (text.empty() ? "" : " ") + std::string{bin.data()};
    }
  }
  return text.empty() ? "-" : text;
}

ConfidenceBins ConfidenceBins::parse(const std::string& text) {
  ConfidenceBins parsed;
  std::istringstream in{text == "-" ? "" : text};
  for (std::string word; in >> word;) {
    std::size_t i = 0;
    Bin bin;
    int used = 0;
    if (std::sscanf(word.c_str(), "%zu:%d:%d:%lf%n", &i, &bin.looks, &bin.right, &bin.stated,
                    &used) != 4 ||
        static_cast<std::size_t>(used) != word.size() || i >= kCount || bin.looks < 1 ||
        bin.right < 0 || bin.right > bin.looks) {
      throw std::invalid_argument("\"" + word + "\" is not bin:looks:right:stated");
    }
    parsed.bins_[i] = bin;
  }
  return parsed;
}

}  // namespace cmn
