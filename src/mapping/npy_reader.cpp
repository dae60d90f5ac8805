// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/npy_reader.hpp"

#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

namespace cmn {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& problem) {
  throw std::runtime_error(path + ": is not a .npy map that can be read: " + problem);
}

struct Header {
  std::string descr;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
};

/// The Python literal {'descr': '<f8', 'fortran_order': False, 'shape': (18, 23), }.
class HeaderParser {
 public:
  HeaderParser(const std::string& text, const std::string& path) : text_{text}, path_{path} {}

  Header parse() {
    Header header;
    int seen = 0;
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr") {
        skip_space();
        if (at_ < text_.size() && text_[at_] == '[') {
          fail(path_, "it holds records, not numbers");
        }
        header.descr = quoted();
        seen |= 1;
      } else if (key == "fortran_order") {
        header.fortran_order = truth();
        seen |= 2;
      } else if (key == "shape") {
        header.shape = tuple();
        seen |= 4;
      } else {
        fail(path_, "the header has an unknown key '" + key + "'");
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (seen != 7) {
      fail(path_, "the header lacks one of descr, fortran_order, shape");
    }
    return header;
  }

 private:
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      ++at_;
    }
  }
  bool accept(char c) {
    skip_space();
    const bool found = at_ < text_.size() && text_[at_] == c;
    at_ += found;
    return found;
  }
  void expect(char c) {
    if (!accept(c)) {
      fail(path_, std::string{"the header has no '"} + c + "' where one is due");
    }
  }
  std::string quoted() {
    const char quote = accept('"') ? '"' : '\'';
    if (quote == '\'') {
      expect('\'');
    }
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string::npos) {
      fail(path_, "the header has a text without end");
    }
    const std::string word = text_.substr(at_, end - at_);
    at_ = end + 1;
    return word;
  }
  bool truth() {
    skip_space();
    for (const bool value : {true, false}) {
      const std::string word = value ? "True" : "False";
      if (text_.compare(at_, word.size(), word) == 0) {
        at_ += word.size();
        return value;
      }
    }
    fail(path_, "fortran_order is neither True nor False");
  }
  std::vector<std::uint64_t> tuple() {
    std::vector<std::uint64_t> numbers;
    expect('(');
    while (!accept(')')) {
      skip_space();
      std::uint64_t number = 0;
      const std::size_t begin = at_;
      for (; at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0;
           ++at_) {
        number = 10 * number + static_cast<std::uint64_t>(text_[at_] - '0');
        if (number > 1'000'000'000U) {
          fail(path_, "the shape is too large for a map");
        }
      }
      if (at_ == begin) {
        fail(path_, "the shape is not a tuple of numbers");
      }
      numbers.push_back(number);
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    return numbers;
  }

  const std::string& text_;
  const std::string& path_;
  std::size_t at_ = 0;
};

template <class T>
double number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

struct NumberType {
  std::size_t bytes;
  std::function<double(const char*)> read;
};

NumberType number_type(const std::string& descr, const std::string& path) {
  static const std::map<std::string, NumberType> kTypes{
      {"f4", {4, number_at<float>}},         {"f8", {8, number_at<double>}},
      {"i1", {1, number_at<std::int8_t>}},   {"i2", {2, number_at<std::int16_t>}},
      {"i4", {4, number_at<std::int32_t>}},  {"i8", {8, number_at<std::int64_t>}},
      {"u1", {1, number_at<std::uint8_t>}},  {"u2", {2, number_at<std::uint16_t>}},
      {"u4", {4, number_at<std::uint32_t>}}, {"u8", {8, number_at<std::uint64_t>}},
      {"b1", {1, number_at<std::uint8_t>}}};
  const auto found = descr.empty() ? kTypes.end() : kTypes.find(descr.substr(1));
  const bool ordered = !descr.empty() && (descr[0] == '<' || descr[0] == '|');
  if (!ordered || found == kTypes.end() || (descr[0] == '|' && found->second.bytes != 1)) {
    fail(path, "its numbers are '" + descr +
                   "'; little-endian f4 f8 i1 i2 i4 i8 u1 u2 u4 u8 b1 are read, so save it with "
                   "array.astype('<f8')");
  }
  return found->second;
}

}  // namespace

Grid<double> read_npy(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  if (!file) {
    throw std::runtime_error(path + ": cannot be opened; is the path right and readable?");
  }
  const std::string bytes{std::istreambuf_iterator<char>{file}, {}};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() < 10 || bytes.compare(0, 6, "\x93NUMPY") != 0) {
    fail(path, "it does not begin with numpy's mark");
  }
  const int version = byte(6);
  if (version < 1 || version > 3) {
    fail(path, "its format version is " + std::to_string(version) + ", known are 1, 2 and 3");
  }
  const std::size_t begin = version == 1 ? 10 : 12;
  if (bytes.size() < begin) {
    fail(path, "it ends within the header");
  }
  std::size_t length = 0;
  for (std::size_t i = begin; i-- > 8;) {
    length = 256 * length + byte(i);
  }
  if (length > bytes.size() - begin) {
    fail(path, "it ends within the header");
  }
  const std::string text = bytes.substr(begin, length);
  const Header header = HeaderParser{text, path}.parse();
  const NumberType type = number_type(header.descr, path);
  if (header.shape.size() != 2 || header.shape[0] == 0 || header.shape[1] == 0) {
    fail(path, "a map has two dimensions, none of them 0");
  }
  const std::uint64_t rows = header.shape[0];
  const std::uint64_t columns = header.shape[1];
  const std::size_t data = begin + length;
  if ((bytes.size() - data) / type.bytes / columns < rows) {  // no product that could overflow
    fail(path, "it ends before the last of its " + std::to_string(rows) + " x " +
                   std::to_string(columns) + " numbers");
  }
  Grid<double> grid{static_cast<int>(columns), static_cast<int>(rows)};
  for (std::uint64_t row = 0; row < rows; ++row) {
    for (std::uint64_t column = 0; column < columns; ++column) {
      const std::uint64_t i = header.fortran_order ? column * rows + row : row * columns + column;
      grid({static_cast<int>(column), static_cast<int>(rows - 1 - row)}) =
          type.read(bytes.data() + data + i * type.bytes);
    }
  }
  return grid;
}

}  // namespace cmn
