// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/route_sampler.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kCell_m = 0.1;
constexpr std::int32_t kStraight = 1000;  // tenths of a millimetre
constexpr std::int32_t kDiagonal = 1414;
constexpr double kUnitsPerMetre = 10000.0;
constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
constexpr int kStarts = 200;  ///< tried before giving up

}  // namespace

RouteSampler::RouteSampler(const World& world, const CoarseMap& extent, double radius_m)
    : T_world_grid_{extent.T_map_grid()} {
  const int width = static_cast<int>(std::floor(extent.width() * extent.resolution() / kCell_m));
  const int height = static_cast<int>(std::floor(extent.height() * extent.resolution() / kCell_m));
  is_drivable_ = Grid<std::uint8_t>{width + 2, height + 2, 0};
  for (int y = 1; y <= height; ++y) {
    for (int x = 1; x <= width; ++x) {
      is_drivable_({x, y}) = world.is_disc_free(to_world({x, y}), radius_m) ? 255 : 0;
    }
  }
  const cv::Mat drivable(height + 2, width + 2, CV_8U, is_drivable_.values().data());
  cv::Mat region_of, statistics, centres;
  const int regions = cv::connectedComponentsWithStats(drivable, region_of, statistics, centres, 4);
  int largest = 0;
  int most = 0;
  for (int i = 1; i < regions; ++i) {
    if (statistics.at<int>(i, cv::CC_STAT_AREA) > most) {
      most = statistics.at<int>(i, cv::CC_STAT_AREA);
      largest = i;
    }
  }
  if (largest == 0) {
    std::ostringstream text;
    text << "the world has no free space for a robot of radius " << radius_m << " m";
    throw std::runtime_error(text.str());
  }
  for (std::size_t i = 0; i < is_drivable_.size(); ++i) {
    const Cell c = is_drivable_.cell_at(i);
    if (region_of.at<int>(c.y, c.x) == largest) {
      cells_.push_back(c);
    } else {
      is_drivable_[i] = 0;
    }
  }
}

Point2 RouteSampler::to_world(Cell c) const {
  return T_world_grid_ * Point2{(c.x - 0.5) * kCell_m, (c.y - 0.5) * kCell_m};
}

double RouteSampler::drivable_m2() const {
  return static_cast<double>(cells_.size()) * kCell_m * kCell_m;
}

Grid<std::int32_t> RouteSampler::ways_from(Cell from, double most_m) const {
  struct Step {
    Cell by;
    std::int32_t length;
  };
  constexpr std::array<Step, 8> kSteps{{{{1, 0}, kStraight},
                                        {{0, 1}, kStraight},
                                        {{-1, 0}, kStraight},
                                        {{0, -1}, kStraight},
                                        {{1, 1}, kDiagonal},
                                        {{-1, 1}, kDiagonal},
                                        {{-1, -1}, kDiagonal},
                                        {{1, -1}, kDiagonal}}};
  const auto most = static_cast<std::int32_t>(most_m * kUnitsPerMetre);
  Grid<std::int32_t> ways{is_drivable_.width(), is_drivable_.height(), kFar};
  // Dial's queue: one bucket a length; lengths in the queue differ by a diagonal at most.
  std::vector<std::vector<Cell>> buckets(kDiagonal + 1);
  ways(from) = 0;
  buckets[0].push_back(from);
  std::size_t waiting = 1;
  for (std::int32_t way = 0; waiting > 0; ++way) {
    std::vector<Cell>& bucket = buckets[static_cast<std::size_t>(way % (kDiagonal + 1))];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const Cell here = bucket[i];
      if (ways(here) != way) {
        continue;
      }
      for (const Step& step : kSteps) {
        const Cell c = here + step.by;
        const bool cuts_a_corner = step.length == kDiagonal && (is_drivable_({here.x, c.y}) == 0 ||
                                                                is_drivable_({c.x, here.y}) == 0);
        const std::int32_t longer = way + step.length;
        if (is_drivable_(c) != 0 && !cuts_a_corner && longer < ways(c) && longer <= most) {
          ways(c) = longer;
          buckets[static_cast<std::size_t>(longer % (kDiagonal + 1))].push_back(c);
          ++waiting;
        }
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
  return ways;
}

std::optional<Route> RouteSampler::sample(double least_m, double most_m,
                                          const std::function<bool(Point2)>& may_be_goal,
                                          std::mt19937_64& rng) const {
  for (int i = 0; i < kStarts; ++i) {
    const Cell start = cells_[draw_index(rng, cells_.size())];
    const Grid<std::int32_t> ways = ways_from(start, most_m);
    std::vector<Cell> goals;
    for (const Cell c : cells_) {
      if (ways(c) != kFar && ways(c) >= least_m * kUnitsPerMetre && may_be_goal(to_world(c))) {
        goals.push_back(c);
      }
    }
    if (goals.empty()) {
      continue;
    }
    const Cell goal = goals[draw_index(rng, goals.size())];
    return route(start, to_world(goal), draw_index(rng, 4), ways(goal));
  }
  return std::nullopt;
}

std::optional<Route> RouteSampler::sample_to(Point2 goal_world, double least_m, double most_m,
                                             const std::function<bool(Point2)>& may_be_start,
                                             std::mt19937_64& rng) const {
  const Point2 p = inverse(T_world_grid_) * goal_world;
  const Cell goal{static_cast<int>(std::floor(p.x / kCell_m)) + 1,
                  static_cast<int>(std::floor(p.y / kCell_m)) + 1};
  if (goal.x < 1 || goal.y < 1 || goal.x + 1 >= is_drivable_.width() ||
      goal.y + 1 >= is_drivable_.height()) {
    return std::nullopt;
  }
  const Grid<std::int32_t> ways = ways_from(goal, most_m);
  std::vector<Cell> starts;
  for (const Cell c : cells_) {
    if (ways(c) != kFar && ways(c) >= least_m * kUnitsPerMetre) {
      starts.push_back(c);
    }
  }
  for (int i = 0; i < kStarts && !starts.empty(); ++i) {
    const Cell start = starts[draw_index(rng, starts.size())];
    const std::size_t quarter = draw_index(rng, 4);
    if (may_be_start(to_world(start))) {
      return route(start, goal_world, quarter, ways(start));
    }
  }
  return std::nullopt;
}

Route RouteSampler::route(Cell start, Point2 goal_world, std::size_t quarter,
                          std::int32_t way) const {
  const Point2 p = to_world(start);
  const double yaw = wrap_angle(T_world_grid_.yaw + static_cast<double>(quarter) * kPi / 2.0);
  return {{p.x, p.y, yaw}, goal_world, way / kUnitsPerMetre};
}

}  // namespace cmn
