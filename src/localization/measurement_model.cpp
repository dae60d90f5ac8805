// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/measurement_model.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>

namespace cmn {
namespace {

/// Raises likelihoods to a power. Sums may have left +-1e-17 where 0 is meant: all that is not
/// above 1e-15 is 0.
void raise(std::vector<double>& values, double exponent) {
  // The greater of 0 and `above`, written without the comparison that keeps loops from vectors.
  const auto cleaned = [](double value) {
    const double above = value - 1e-15;
    return 0.5 * (above + std::abs(above));
  };
  if (exponent == 2.0) {
    for (double& value : values) {
      const double likelihood = cleaned(value);
      value = likelihood * likelihood;
    }
    return;
  }
  for (double& value : values) {
    value = cleaned(value);
  }
  if (exponent != 1.0) {
    cv::Mat all(1, static_cast<int>(values.size()), CV_64F, values.data());
    cv::pow(all, exponent, all);
  }
}

/// table[code] = `start` + the sum of by_bit[i] over the set bits i of the code.
void fill_subset_sums(double start, const double* by_bit, int bits, double* table) {
  table[0] = start;
  for (int bit = 0; bit < bits; ++bit) {
    const std::size_t first = std::size_t{1} << static_cast<unsigned>(bit);
    const double added = by_bit[bit];
    for (std::size_t code = 0; code < first; ++code) {
      table[first + code] = table[code] + added;
    }
  }
}

/// Where cell `w` of a window seen by a robot of heading `h` lies in the map's axes.
Cell in_map_axes(int w, int n, Heading h) {
  const Cell from_middle{w % n - n / 2, w / n - n / 2};
  return turned(from_middle, index(h));
}

/// Of some cells of an observation: how many count, and how much of them is occupied.
struct Tally {
  double weight = 0.0;
  double occupied = 0.0;
  void add(double share, const Tally& cells) {
    weight += share * cells.weight;
    occupied += share * cells.occupied;
  }
};

/// Of the cells [first, last), summed four at a time: with occupancies of 0, 0.5 and 1 that is
/// exact.
Tally tally_of(const LocalOccupancy& seen, bool unseen_counts, std::size_t first,
               std::size_t last) {
  std::array<double, 4> weight{};
  std::array<double, 4> occupied{};
  const auto add = [&](std::size_t i, std::size_t lane) {
    const bool counts = unseen_counts || seen.confidence[i] > 0.0F;
    weight[lane] += counts ? 1.0 : 0.0;
    occupied[lane] += counts ? static_cast<double>(seen.occupancy[i]) : 0.0;
  };
  std::size_t i = first;
  for (; i + 4 <= last; i += 4) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      add(i + lane, lane);
    }
  }
  for (; i < last; ++i) {
    add(i, 0);
  }
  return {weight[0] + weight[1] + weight[2] + weight[3],
          occupied[0] + occupied[1] + occupied[2] + occupied[3]};
}

/// A stretch of a row of fine cells of which the same share lies in a coarse one.
struct Stretch {
  int first;
  int last;  ///< not included
  int bin;
  double share;
};

/// A row of `size` fine cells cut at the borders of the n coarse ones: a fine cell on a border has
/// a share in both.
std::vector<Stretch> stretches(int size, double fine_m, double coarse_m, int n) {
  std::vector<Stretch> cut;
  const auto add = [&](int i, int bin, double share) {
    if (bin < 0 || bin >= n || share == 0.0) {
      return;
    }
    if (share == 1.0 && !cut.empty() && cut.back().bin == bin && cut.back().share == 1.0) {
      cut.back().last = i + 1;
    } else {
      cut.push_back({i, i + 1, bin, share});
    }
  };
  const double middle = 0.5 * (size - 1);
  for (int i = 0; i < size; ++i) {
    const double low = (i - 0.5 - middle) * fine_m / coarse_m + 0.5 * n;
    const double high = (i + 0.5 - middle) * fine_m / coarse_m + 0.5 * n;
    const int first = static_cast<int>(std::floor(low));
    const double border = first + 1.0;
    const double part = high <= border ? 1.0 : (border - low) / (high - low);
    add(i, first, part);
    add(i, first + 1, 1.0 - part);
  }
  return cut;
}

void tally_by_area(const LocalOccupancy& seen, const MeasurementModelParams& params,
                   std::vector<Tally>& bins) {
  const int n = params.window_cells();
  const std::vector<Stretch> cut = stretches(seen.size, seen.resolution, params.window_m / n, n);
  for (const Stretch& rows : cut) {
    for (int iy = rows.first; iy < rows.last; ++iy) {
      for (const Stretch& x : cut) {
        bins[static_cast<std::size_t>(rows.bin * n + x.bin)].add(
            rows.share * x.share,
            tally_of(seen, params.unseen_is_occupied, seen.index_of(x.first, iy),
                     seen.index_of(x.last - 1, iy) + 1));
      }
    }
  }
}

/// Each fine cell counts where its middle lies.
void tally_by_centres(const LocalOccupancy& seen, const MeasurementModelParams& params,
                      double residual_yaw_rad, std::vector<Tally>& bins) {
  const int n = params.window_cells();
  const double coarse_m = params.window_m / n;
  const double c = std::cos(residual_yaw_rad) * seen.resolution / coarse_m;
  const double s = std::sin(residual_yaw_rad) * seen.resolution / coarse_m;
  const double middle = 0.5 * (seen.size - 1);
  for (int iy = 0; iy < seen.size; ++iy) {
    const auto position = [&](int ix) {
      return Point2{c * (ix - middle) - s * (iy - middle) + 0.5 * n,
                    s * (ix - middle) + c * (iy - middle) + 0.5 * n};
    };
    const auto bin_at = [&](Point2 p) { return Cell{whole_below(p.x), whole_below(p.y)}; };
    // So far a row can go on from p before its x, or y, comes to the next border.
    const auto room = [](double p, int bin, double slope) {
      return slope > 0.0   ? (bin + 1 - p) / slope
             : slope < 0.0 ? (bin - p) / slope
                           : std::numeric_limits<double>::infinity();
    };
    for (int first = 0, last = 0; first < seen.size; first = last) {
      const Point2 p = position(first);
      const Cell bin = bin_at(p);
      // To just before the border, and from there by looking.
      const double way = std::min({room(p.x, bin.x, c), room(p.y, bin.y, s), double(seen.size)});
      last = std::min(first + std::max(1, static_cast<int>(way)), seen.size);
      while (last < seen.size && bin_at(position(last)) == bin) {
        ++last;
      }
      if (bin.x >= 0 && bin.y >= 0 && bin.x < n && bin.y < n) {
        bins[static_cast<std::size_t>(bin.y * n + bin.x)].add(
            1.0, tally_of(seen, params.unseen_is_occupied, seen.index_of(first, iy),
                          seen.index_of(0, iy) + static_cast<std::size_t>(last)));
      }
    }
  }
}

}  // namespace

std::vector<double> reduce(const LocalOccupancy& seen, const MeasurementModelParams& params,
                           double residual_yaw_rad) {
  const int n = params.window_cells();
  std::vector<Tally> bins(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  if (residual_yaw_rad == 0.0) {
    tally_by_area(seen, params, bins);
  } else {
    tally_by_centres(seen, params, residual_yaw_rad, bins);
  }
  std::vector<double> window;
  for (const Tally& bin : bins) {
    window.push_back(bin.weight > 0.0 ? bin.occupied / bin.weight : 0.5);
  }
  return window;
}

OverlapModel::OverlapModel(const CoarseMap& map, const MeasurementModelParams& params)
    : params_{params}, kinds_{map, params.window_reach}, sums_(kinds_.pieces) {
  for (std::vector<double>& values : likelihood_) {
    values.assign(kinds_.size(), 0.0);
  }
}

const Likelihood& OverlapModel::measure(const LocalOccupancy& seen, double residual_yaw_rad,
                                        double weight, const HeadingSet& headings) {
  const std::vector<double> window = reduce(seen, params_, residual_yaw_rad);
  for (const Heading h : kHeadings) {
    if (headings[static_cast<std::size_t>(index(h))]) {
      fill(window, h, weight * params_.exponent);
    }
  }
  return likelihood_;
}

void OverlapModel::fill(const std::vector<double>& window, Heading heading, double exponent) {
  // |m_hat - m| is m_hat where the map is free and 1 - m_hat where it is occupied: linear in the
  // map's bits.
  const int n = params_.window_cells();
  std::vector<double> by_bit(window.size());
  double free_everywhere = n * n;
  for (int w = 0; w < n * n; ++w) {
    const double m_hat = window[static_cast<std::size_t>(w)];
    const Cell offset = in_map_axes(w, n, heading);
    by_bit[static_cast<std::size_t>((offset.y + n / 2) * n + offset.x + n / 2)] =
        (2.0 * m_hat - 1.0) / (n * n);
    free_everywhere -= m_hat;
  }
  for (std::size_t piece = 0; piece < sums_.size(); ++piece) {
    const int first = static_cast<int>(piece) * kPieceBits;
    fill_subset_sums(piece == 0 ? free_everywhere / (n * n) : 0.0, by_bit.data() + first,
                     std::min(kPieceBits, n * n - first), sums_[piece].data());
  }
  std::vector<double>& values = likelihood_[static_cast<std::size_t>(index(heading))];
  const std::uint16_t* codes = kinds_.codes.data();
  for (double& value : values) {
    double sum = sums_[0][*codes++];
    for (std::size_t piece = 1; piece < sums_.size(); ++piece) {
      sum += sums_[piece][*codes++];
    }
    value = sum;
  }
  raise(values, exponent);
}

std::unique_ptr<MeasurementModel> make_measurement_model(const MeasurementModelParams& params,
                                                         const CoarseMap& map) {
  assert(params.type == "overlap");  // the parameter walk admits no other word
  return std::make_unique<OverlapModel>(map, params);
}

}  // namespace cmn
