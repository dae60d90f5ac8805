// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/cell_choice.hpp"

#include "coarse_map_nav/mapping/image_reader.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kSmallestThing = 0.25;  ///< [cells] rooms and obstacles below it may vanish
constexpr std::size_t kLongestDoor =
    3;                              ///< [cells] the occupied cells that a door may lead through
constexpr int kDetour = 6;          ///< [cells] a way round a door that makes up for it
constexpr int kSmallestPocket = 4;  ///< [cells] free cells without a way are filled below it
constexpr int kAttempts = 6;        ///< [-] ways to lead a door that are tried from one cell
constexpr int kFar = 1 << 20;       ///< [cells] more than any search is asked to go

}  // namespace

void CellChoice::vote() {
  std::vector<int> largest(static_cast<std::size_t>(pieces_.component_count()), kOccupied);
  std::vector<bool> has_cell(largest.size(), false);
  for (int piece = 0; piece < pieces_.size(); ++piece) {
    const auto component = static_cast<std::size_t>(pieces_[piece].component);
    if (pieces_[piece].share > 0.5) {
      chosen_(pieces_[piece].cell) = piece;
      has_cell[component] = true;
    }
    if (largest[component] == kOccupied ||
        pieces_[piece].share > pieces_[largest[component]].share) {
      largest[component] = piece;
    }
  }
  for (std::size_t i = 0; i < largest.size(); ++i) {
    if (!has_cell[i] && pieces_[largest[i]].share >= kSmallestThing) {
      chosen_(pieces_[largest[i]].cell) = largest[i];
    }
  }
}

std::vector<Cell> CellChoice::broken_walls(Cell c) const {
  std::vector<Cell> broken;
  for (const Heading h : kHeadings) {
    const Cell next = c + unit_step(h);
    if (is_free(next) && !pieces_.joined(chosen_(c), chosen_(next))) {
      broken.push_back(next);
    }
  }
  return broken;
}

void CellChoice::keep_walls() {
  std::vector<int> cells_left(static_cast<std::size_t>(pieces_.component_count()), 0);
  std::vector<Cell> suspects;
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    if (chosen_[i] != kOccupied) {
      ++cells_left[static_cast<std::size_t>(pieces_[chosen_[i]].component)];
      if (!broken_walls(chosen_.cell_at(i)).empty()) {
        suspects.push_back(chosen_.cell_at(i));
      }
    }
  }
  std::stable_sort(suspects.begin(), suspects.end(), [&](Cell a, Cell b) {
    return pieces_[chosen_(a)].share < pieces_[chosen_(b)].share;
  });
  // A room keeps its last cell in the first round, unless two such cells stand against each other.
  for (const bool spare_last : {true, false}) {
    for (const Cell c : suspects) {
      if (is_free(c) && !broken_walls(c).empty()) {
        int& left = cells_left[static_cast<std::size_t>(pieces_[chosen_(c)].component)];
        if (left > 1 || !spare_last) {
          chosen_(c) = kOccupied;
          --left;
        }
      }
    }
  }
}

/// Dijkstra over pieces that are not chosen, from chosen ones to the nearest goal; the result holds
/// both ends, and is empty when there is no way of up to `longest` pieces in between that avoids
/// the barred ones. A piece costs the more the less of its cell is free.
CellChoice::Path CellChoice::cheapest_path(const std::vector<int>& from, std::size_t longest,
                                           const std::vector<int>& barred,
                                           const std::function<bool(int)>& is_goal) const {
  struct Visit {
    double cost;
    int piece;
    std::size_t steps;
    bool operator<(const Visit& other) const { return cost > other.cost; }
  };
  std::map<int, std::pair<double, int>> best;  // piece -> cost, the piece before
  std::priority_queue<Visit> front;
  for (const int piece : from) {
    best[piece] = {0.0, piece};
    front.push({0.0, piece, 0});
  }
  while (!front.empty()) {
    const Visit visit = front.top();
    front.pop();
    if (visit.cost > best[visit.piece].first) {
      continue;
    }
    if (visit.steps > 0 && is_chosen(visit.piece)) {
      Path path{visit.piece};
      while (best[path.back()].second != path.back()) {
        path.push_back(best[path.back()].second);
      }
      return path;
    }
    for (const int next : pieces_[visit.piece].links) {
      const bool chosen = is_chosen(next);
      if (chosen ? visit.steps == 0 || !is_goal(next) : visit.steps == longest) {
        continue;
      }
      if (std::find(barred.begin(), barred.end(), next) != barred.end()) {
        continue;
      }
      const double cost = visit.cost + (chosen ? 0.0 : 1.5 - pieces_[next].share);
      const auto known = best.find(next);
      if (known == best.end() || cost < known->second.first) {
        best[next] = {cost, visit.piece};
        front.push({cost, next, visit.steps + 1});
      }
    }
  }
  return {};
}

int CellChoice::distance(Cell from, Cell to, int limit) const {
  std::map<std::size_t, int> reached{{chosen_.index_of(from), 0}};
  std::queue<Cell> front;
  front.push(from);
  while (!front.empty()) {
    const Cell c = front.front();
    front.pop();
    const int steps = reached[chosen_.index_of(c)];
    if (c == to) {
      return steps;
    }
    for (const Heading h : kHeadings) {
      const Cell next = c + unit_step(h);
      if (steps < limit && is_free(next) && reached.count(chosen_.index_of(next)) == 0) {
        reached[chosen_.index_of(next)] = steps + 1;
        front.push(next);
      }
    }
  }
  return kFar;
}

/// Whether occupying a free cell leaves two of its free neighbours without a short way round.
bool CellChoice::cuts_a_way(Cell c) const {
  CellChoice without = *this;
  without.chosen_(c) = kOccupied;
  std::vector<Cell> neighbours;
  for (const Heading h : kHeadings) {
    if (is_free(c + unit_step(h))) {
      neighbours.push_back(c + unit_step(h));
    }
  }
  for (std::size_t i = 1; i < neighbours.size(); ++i) {
    if (without.distance(neighbours[0], neighbours[i], kDetour) == kFar) {
      return true;
    }
  }
  return false;
}

/// Chooses the pieces of a path and gives up the cells that these would break into. False, and
/// nothing changed, when that would cut another way.
bool CellChoice::free_path(const Path& path) {
  const Grid<int> before = chosen_;
  std::vector<Cell> given_up;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Cell cell = pieces_[path[i]].cell;
    if (is_free(cell)) {
      given_up.push_back(cell);
    }
    chosen_(cell) = path[i];
  }
  for (const int piece : path) {
    if (!is_chosen(piece)) {  // the path crosses a cell twice
      chosen_ = before;
      return false;
    }
    for (const Cell c : broken_walls(pieces_[piece].cell)) {
      chosen_(c) = kOccupied;
      given_up.push_back(c);
    }
  }
  for (const Cell c : given_up) {
    std::vector<Cell> neighbours;
    for (const Heading h : kHeadings) {
      const Cell next = c + unit_step(h);
      if (before.contains(next) && before(next) != kOccupied && before(next) == chosen_(next)) {
        neighbours.push_back(next);
      }
    }
    for (std::size_t i = 1; i < neighbours.size(); ++i) {
      if (distance(neighbours[0], neighbours[i], kDetour) == kFar) {
        chosen_ = before;
        return false;
      }
    }
  }
  for (const int piece : path) {
    if (!is_chosen(piece)) {  // a piece of the path was itself given up
      chosen_ = before;
      return false;
    }
  }
  return true;
}

void CellChoice::keep_doors() {
  for (int start = 0; start < pieces_.size(); ++start) {
    if (!is_chosen(start)) {
      continue;
    }
    const Cell from = pieces_[start].cell;
    const int limit = static_cast<int>(kLongestDoor) + kDetour;
    std::vector<int> barred;
    for (int attempt = 0; attempt < kAttempts && is_chosen(start); ++attempt) {
      const Path path = cheapest_path({start}, kLongestDoor, barred, [&](int goal) {
        return distance(from, pieces_[goal].cell, limit) == kFar;
      });
      if (path.empty()) {
        break;
      }
      if (!free_path(path)) {
        barred.push_back(path[path.size() / 2]);
      }
    }
  }
}

/// Numbers the 4-connected sets of free cells; with the size and the fine component of each.
Grid<int> CellChoice::label_rooms(std::vector<int>& sizes, std::vector<int>& components) const {
  Grid<int> room{chosen_.width(), chosen_.height(), -1};
  sizes.clear();
  components.clear();
  std::vector<Cell> front;
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    if (chosen_[i] == kOccupied || room[i] >= 0) {
      continue;
    }
    const int label = static_cast<int>(sizes.size());
    sizes.push_back(0);
    components.push_back(pieces_[chosen_[i]].component);
    front.assign(1, chosen_.cell_at(i));
    room[i] = label;
    while (!front.empty()) {
      const Cell c = front.back();
      front.pop_back();
      ++sizes.back();
      for (const Heading h : kHeadings) {
        const Cell next = c + unit_step(h);
        if (is_free(next) && room(next) < 0) {
          room(next) = label;
          front.push_back(next);
        }
      }
    }
  }
  return room;
}

void CellChoice::join_rooms() {
  std::vector<int> sizes;
  std::vector<int> components;
  std::vector<int> given_up;  // pieces whose rooms could not be joined
  for (bool joined = true; joined;) {
    joined = false;
    const Grid<int> room = label_rooms(sizes, components);
    std::vector<std::vector<int>> pieces_of(sizes.size());
    for (std::size_t i = 0; i < room.size(); ++i) {
      if (room[i] >= 0) {
        pieces_of[static_cast<std::size_t>(room[i])].push_back(chosen_[i]);
      }
    }
    std::vector<int> order(sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return sizes[static_cast<std::size_t>(a)] < sizes[static_cast<std::size_t>(b)];
    });
    for (const int label : order) {
      const std::vector<int>& own = pieces_of[static_cast<std::size_t>(label)];
      if (std::find(given_up.begin(), given_up.end(), own.front()) != given_up.end()) {
        continue;
      }
      const Path path = cheapest_path(own, static_cast<std::size_t>(kFar), {},
                                      [&](int goal) { return room(pieces_[goal].cell) != label; });
      const Grid<int> before = chosen_;
      joined = !path.empty() && free_path(path);
      if (joined) {
        label_rooms(sizes, components);
        joined = sizes.size() < order.size();  // fewer rooms each time: this ends
      }
      if (joined) {
        break;
      }
      chosen_ = before;
      given_up.push_back(own.front());
    }
  }
}

void CellChoice::keep_obstacles(const Grid<std::uint8_t>& occupied, double pixels_per_cell) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count =
      cv::connectedComponentsWithStats(image_of(occupied), labels, stats, centroids, 8, CV_32S);
  std::vector<std::map<std::size_t, int>> area(static_cast<std::size_t>(count));  // by cell
  std::vector<bool> kept(static_cast<std::size_t>(count), false);
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Cell pixel = occupied.cell_at(i);
    const auto label =
        static_cast<std::size_t>(labels.at<int>(occupied.height() - 1 - pixel.y, pixel.x));
    if (label > 0) {
      const Cell cell = pieces_.cell_of(pixel);
      ++area[label][chosen_.index_of(cell)];
      kept[label] = kept[label] || !is_free(cell);
    }
  }
  for (int label = 1; label < count; ++label) {
    const auto i = static_cast<std::size_t>(label);
    if (kept[i] || stats.at<int>(label, cv::CC_STAT_AREA) <
                       kSmallestThing * pixels_per_cell * pixels_per_cell) {
      continue;
    }
    std::vector<std::pair<int, std::size_t>> cells;
    for (const auto& entry : area[i]) {
      cells.emplace_back(-entry.second, entry.first);
    }
    std::sort(cells.begin(), cells.end());
    for (const auto& entry : cells) {
      const Cell c = chosen_.cell_at(entry.second);
      if (!cuts_a_way(c)) {
        chosen_(c) = kOccupied;
        break;
      }
    }
  }
}

void CellChoice::fill_pockets() {
  std::vector<int> sizes;
  std::vector<int> components;
  const Grid<int> room = label_rooms(sizes, components);
  std::map<int, int> largest;  // fine component -> size of its largest room
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    largest[components[i]] = std::max(largest[components[i]], sizes[i]);
  }
  for (std::size_t i = 0; i < room.size(); ++i) {
    if (room[i] >= 0) {
      const auto label = static_cast<std::size_t>(room[i]);
      if (sizes[label] < kSmallestPocket && sizes[label] < largest[components[label]]) {
        chosen_[i] = kOccupied;
      }
    }
  }
}

Grid<std::uint8_t> CellChoice::occupied() const {
  Grid<std::uint8_t> grid{chosen_.width(), chosen_.height()};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    grid[i] = chosen_[i] == kOccupied;
  }
  return grid;
}

}  // namespace cmn
