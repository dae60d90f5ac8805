// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables in Markdown and the numbers in them.
#pragma once

#include "coarse_map_nav/evaluation/metrics.hpp"

#include <string>
#include <vector>

namespace cmn {

/// What stands where there is no number.
constexpr const char* kNoNumber = "-";

/// A number by a printf format for a double, or a dash where there is none.
std::string number_text(const char* format, double value);
/// A share in per cent, with one decimal.
std::string percent_text(double share);
/// "81.0 (66.9-90.2)", all in per cent.
std::string interval_text(const Figure& figure);
/// "+3.1 (-1.0 to +7.2)": a difference in points of a hundred.
std::string difference_text(const Figure& figure);

/// One line of a table; bars and line ends in the cells are made harmless.
std::string table_row(const std::vector<std::string>& cells);
/// The head of a table whose first column is left-aligned, the others right-aligned.
std::string table_head(const std::vector<std::string>& cells);

}  // namespace cmn
