// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace cmn {
namespace {

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// In the two largest units that matter.
std::string duration_text(double seconds) {
  const auto s = static_cast<long>(std::ceil(std::min(seconds, 99.0 * 86400.0)));
  if (s < 60) {
    return text_of("%ld s", s);
  }
  if (s < 3600) {
    return text_of("%ld min %02ld s", s / 60, s % 60);
  }
  return s < 86400 ? text_of("%ld h %02ld min", s / 3600, s % 3600 / 60)
                   : text_of("%ld d %02ld h", s / 86400, s % 86400 / 3600);
}

}  // namespace

std::string progress_line(const Progress& progress) {
  constexpr std::size_t kWidth = 20;
  const std::size_t done = std::min(progress.done, progress.total);
  const double share =
      progress.total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(progress.total);
  const auto filled = static_cast<std::size_t>(share * kWidth);
  std::string line = "[" + std::string(filled, '#') + std::string(kWidth - filled, '-') + "]";
  line += text_of(" %3d %%  %zu/%zu", static_cast<int>(100.0 * share), done, progress.total);
  if (!std::isnan(progress.success_share)) {
    line += text_of("  SR %.2f", progress.success_share);
  }
  if (done > progress.done_before && progress.elapsed_s > 0.0) {
    const double rate_hz = static_cast<double>(done - progress.done_before) / progress.elapsed_s;
    line += rate_hz >= 1.0 ? text_of("  %.1f/s", rate_hz) : text_of("  %.1f/min", 60.0 * rate_hz);
    line +=
        done == progress.total
            ? "  " + duration_text(progress.elapsed_s)
            : "  " + duration_text(static_cast<double>(progress.total - done) / rate_hz) + " left";
  }
  return line;
}

}  // namespace cmn
