// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rounding for inner loops: without SSE4.1 std::floor is a call.
#pragma once

namespace cmn {

/// The greatest whole number not above `x`, which an int can hold.
constexpr int whole_below(double x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - static_cast<int>(x < towards_zero);
}

}  // namespace cmn
