// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// P(heading, cell): where the robot may be on the drawing.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace cmn {

/// The most probable state.
struct Estimate {
  Heading heading = Heading::kEast;
  Cell cell;
  double probability = 0.0;
};
inline bool operator==(const Estimate& a, const Estimate& b) {
  return a.heading == b.heading && a.cell == b.cell;
}

/// Four layers, one a heading, of one probability a cell; all layers together sum to 1 (Robb,
/// "Extending DBF to Localize Orientation").
///
/// Layers are stored as unnormalised weights with one common factor, so that a filter step may pass
/// over the memory once and normalise by setting the factor. Each layer has a border of one cell
/// of weight 0 all around, so that a step of one cell never leaves the array.
class Belief {
 public:
  Belief() = default;
  /// Zero everywhere: not yet a distribution.
  Belief(int width, int height) : width_{width}, height_{height} {
    for (auto& layer : layers_) {
      layer.assign(padded_size(), 0.0);
    }
  }
  /// The same probability on every free cell of every layer.
  static Belief uniform(const CoarseMap& map);

  int width() const { return width_; }
  int height() const { return height_; }
  bool contains(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < width_ && c.y < height_; }
  double operator()(Heading h, Cell c) const { return factor_ * layer(h)[padded_index(c)]; }
  /// Sets one weight; call normalise() before the belief is read again.
  void set_weight(Heading h, Cell c, double weight) {
    layers_[static_cast<std::size_t>(index(h))][padded_index(c)] = weight;
  }
  /// Scales to sum 1. False, and nothing changed, when the sum is 0 or not finite.
  bool normalise();

  // For the filter's inner loops.
  int stride() const { return width_ + 2; }
  std::size_t padded_size() const {
    return static_cast<std::size_t>(width_ + 2) * static_cast<std::size_t>(height_ + 2);
  }
  std::size_t padded_index(Cell c) const {
    return static_cast<std::size_t>(c.y + 1) * static_cast<std::size_t>(width_ + 2) +
           static_cast<std::size_t>(c.x + 1);
  }
  std::vector<double>& layer(Heading h) { return layers_[static_cast<std::size_t>(index(h))]; }
  const std::vector<double>& layer(Heading h) const {
    return layers_[static_cast<std::size_t>(index(h))];
  }
  double factor() const { return factor_; }
  void set_factor(double factor) { factor_ = factor; }
  /// The robot turned: the layer of heading h becomes that of h + quarter_turns. O(1).
  void roll(int quarter_turns);

 private:
  int width_ = 0;
  int height_ = 0;
  double factor_ = 1.0;
  std::array<std::vector<double>, 4> layers_;
};

/// P(cell), headings summed out.
Grid<double> marginal(const Belief& belief);
/// Shannon entropy over all headings and cells [nats].
double entropy(const Belief& belief);
/// The probability of the estimate's heading within `radius_cells` of its cell.
double mass_near(const Belief& belief, const Estimate& estimate, double radius_cells);

/// The `count` most probable states, best first, none within `separation_cells` of a better one of
/// the same heading.
std::vector<Estimate> best_hypotheses(const Belief& belief, std::size_t count,
                                      int separation_cells);
/// The spread of a belief about a state: second moments of the position about its cell [cells^2]
/// and the mean squared yaw difference to its heading [rad^2].
struct Spread {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double yaw = 0.0;
};
Spread spread_about(const Belief& belief, const Estimate& estimate);

}  // namespace cmn
