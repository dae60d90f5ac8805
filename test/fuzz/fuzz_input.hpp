// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A fuzzer's bytes as numbers and words, and seeds made of the same.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace cmn {

/// Reads from the front. What is not there any more is 0 and empty.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : data_{data}, size_{size} {}

  template <class Number>
  Number take() {
    Number value{};
    const std::size_t count = std::min(size_, sizeof value);
    if (count > 0) {
      std::memcpy(&value, data_, count);
    }
    skip(count);
    return value;
  }
  /// A byte of length, then so many letters.
  std::string take_word() {
    const std::size_t length = std::min<std::size_t>(take<std::uint8_t>(), size_);
    std::string word(reinterpret_cast<const char*>(data_), length);
    skip(length);
    return word;
  }
  std::vector<std::uint8_t> rest() const { return {data_, data_ + size_}; }

 private:
  void skip(std::size_t count) {
    data_ += count;
    size_ -= count;
  }
  const std::uint8_t* data_;
  std::size_t size_;
};

/// Writes what FuzzInput reads.
class FuzzSeed {
 public:
  template <class Number>
  FuzzSeed& put(Number value) {
    const auto* bytes = reinterpret_cast<const char*>(&value);
    text_.append(bytes, sizeof value);
    return *this;
  }
  FuzzSeed& put_word(const std::string& word) {
    text_ += static_cast<char>(word.size());
    text_ += word;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Ends the fuzzer with a finding.
inline void require(bool holds, const char* what) {
  if (!holds) {
    std::cerr << "must hold: " << what << '\n';
    std::abort();
  }
}

/// Of each fuzzer: good inputs, to start from.
std::vector<std::string> fuzz_seeds();

}  // namespace cmn

/// `FUZZER --seeds DIR` writes them. Not inline, since nobody here calls it: a fuzzer is one file.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc == 3 && std::string{(*argv)[1]} == "--seeds") {
    int number = 0;
    for (const std::string& seed : cmn::fuzz_seeds()) {
      const std::string name = std::string{(*argv)[2]} + "/seed" + std::to_string(number++);
      if (!(std::ofstream{name, std::ios::binary} << seed)) {
        std::cerr << name << ": cannot be written\n";
        std::exit(EXIT_FAILURE);
      }
    }
    std::exit(EXIT_SUCCESS);
  }
  return 0;
}
