// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/table_text.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace cmn {
namespace {

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// A vertical bar would end the cell.
std::string cell_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  }
  return result;
}

}  // namespace

std::string number_text(const char* format, double value) {
  return std::isnan(value) ? kNoNumber : text_of(format, value);
}

std::string percent_text(double share) { return number_text("%.1f", 100.0 * share); }

std::string interval_text(const Figure& figure) {
  return std::isnan(figure.value) ? kNoNumber
                                  : text_of("%.1f (%.1f-%.1f)", 100.0 * figure.value,
                                            100.0 * figure.low, 100.0 * figure.high);
}

std::string difference_text(const Figure& figure) {
  return std::isnan(figure.value) ? kNoNumber
                                  : text_of("%+.1f (%+.1f to %+.1f)", 100.0 * figure.value,
                                            100.0 * figure.low, 100.0 * figure.high);
}

std::string table_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += " " + cell_text(cell) + " |";
  }
  return line + "\n";
}

std::string table_head(const std::vector<std::string>& cells) {
  std::string line = table_row(cells) + "|---|";
  for (std::size_t i = 1; i < cells.size(); ++i) {
    line += "---:|";
  }
  return line + "\n";
}

}  // namespace cmn
