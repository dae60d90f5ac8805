// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/sight_score.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace cmn {
namespace {

constexpr int kSize = 64;
constexpr double kSide_m = 3.2;

LidarParams without_errors() {
  LidarParams params;
  params.beams = 720;
  params.range_min_m = 0.0;
  params.noise_m = params.noise_share = params.dropout = 0.0;
  return params;
}

enum class Ground : std::uint8_t { kUnknown, kFree, kObstacle };

Ground ground_of(const LocalOccupancy& seen, std::size_t i) {
  if (!(seen.confidence[i] > 0.0F)) {
    return Ground::kUnknown;
  }
  return seen.occupancy[i] > 0.5F ? Ground::kObstacle : Ground::kFree;
}

/// What is said of the cells of the square.
std::vector<Ground> on_square(const LocalOccupancy& seen) {
  std::vector<Ground> cells;
  cells.reserve(kSize * kSize);
  const auto cell_at = [&](int i) {
    const double from_middle_m = (i + 0.5) * kSide_m / kSize - 0.5 * kSide_m;
    return whole_below(from_middle_m / seen.resolution + 0.5 * seen.size);
  };
  for (int iy = 0; iy < kSize; ++iy) {
    for (int ix = 0; ix < kSize; ++ix) {
      const int x = cell_at(ix);
      const int y = cell_at(iy);
      const bool is_in = x >= 0 && y >= 0 && x < seen.size && y < seen.size;
      cells.push_back(is_in ? ground_of(seen, seen.index_of(x, y)) : Ground::kUnknown);
    }
  }
  return cells;
}

bool is_obstacle_near(const std::vector<Ground>& cells, int x, int y) {
  for (int iy = std::max(0, y - 1); iy <= std::min(kSize - 1, y + 1); ++iy) {
    for (int ix = std::max(0, x - 1); ix <= std::min(kSize - 1, x + 1); ++ix) {
      if (cells[static_cast<std::size_t>(iy) * kSize + static_cast<std::size_t>(ix)] ==
          Ground::kObstacle) {
        return true;
      }
    }
  }
  return false;
}

double share(std::size_t of, std::size_t all) {
  return all == 0 ? std::numeric_limits<double>::quiet_NaN()
                  : static_cast<double>(of) / static_cast<double>(all);
}

}  // namespace

SightScore::SightScore(const World& world)
    : world_{world}, sensor_{without_errors(), 0}, projector_{{kSize, kSide_m, 0.0}} {}

void SightScore::add(const LocalOccupancy& seen, const Pose2& T_world_robot) {
  const std::vector<Ground> truth =
      on_square(projector_.project(sensor_.measure(world_, T_world_robot, 0.0)));
  const std::vector<Ground> said = on_square(seen);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x);
      if (truth[i] == Ground::kUnknown) {
        continue;
      }
      free_both_ += truth[i] == Ground::kFree && said[i] == Ground::kFree;
      free_any_ += truth[i] == Ground::kFree || said[i] == Ground::kFree;
      if (truth[i] == Ground::kObstacle) {
        (is_obstacle_near(said, x, y) ? found_ : missed_) += 1;
      } else if (said[i] == Ground::kObstacle) {
        ghosts_ += !is_obstacle_near(truth, x, y);
      }
    }
  }
}

double SightScore::free_iou() const { return share(free_both_, free_any_); }

double SightScore::obstacle_iou() const { return share(found_, found_ + missed_ + ghosts_); }

}  // namespace cmn
