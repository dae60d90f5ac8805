// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/measurement_model.hpp"

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/localization/neighbourhood.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

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

}  // namespace

std::vector<double> reduce(const LocalOccupancy& seen, const MeasurementModelParams& params,
                           double residual_yaw_rad) {
  const int n = params.window_cells();
  const double cell_m = params.window_m / n;
  const auto bins = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  std::vector<double> weight(bins, 0.0);
  std::vector<double> occupied(bins, 0.0);

  const double middle = 0.5 * (seen.size - 1);
  const auto counts = [&](std::size_t i) {
    return params.unseen_is_occupied || seen.confidence[i] > 0.0F;
  };
  if (residual_yaw_rad == 0.0) {
    // A fine cell covers parts of up to 2 x 2 coarse ones; its share along each axis.
    struct Share {
      int bin;
      double part;
    };
    std::vector<std::array<Share, 2>> shares;
    for (int i = 0; i < seen.size; ++i) {
      const double low = (i - 0.5 - middle) * seen.resolution / cell_m + 0.5 * n;
      const double high = (i + 0.5 - middle) * seen.resolution / cell_m + 0.5 * n;
      const int first = static_cast<int>(std::floor(low));
      const double border = first + 1.0;
      const double part = high <= border ? 1.0 : (border - low) / (high - low);
      const auto share = [n](int bin, double p) {
        return bin >= 0 && bin < n ? Share{bin, p} : Share{0, 0.0};
      };
      shares.push_back({share(first, part), share(first + 1, 1.0 - part)});
    }
    std::vector<double> row_weight(static_cast<std::size_t>(n));
    std::vector<double> row_occupied(static_cast<std::size_t>(n));
    for (int iy = 0; iy < seen.size; ++iy) {
      std::fill(row_weight.begin(), row_weight.end(), 0.0);
      std::fill(row_occupied.begin(), row_occupied.end(), 0.0);
      for (int ix = 0; ix < seen.size; ++ix) {
        const std::size_t i = seen.index_of(ix, iy);
        if (counts(i)) {
          for (const Share& x : shares[static_cast<std::size_t>(ix)]) {
            row_weight[static_cast<std::size_t>(x.bin)] += x.part;
            row_occupied[static_cast<std::size_t>(x.bin)] +=
                x.part * static_cast<double>(seen.occupancy[i]);
          }
        }
      }
      for (const Share& y : shares[static_cast<std::size_t>(iy)]) {
        const auto first = static_cast<std::size_t>(y.bin * n);
        for (std::size_t x = 0; x < row_weight.size(); ++x) {
          weight[first + x] += y.part * row_weight[x];
          occupied[first + x] += y.part * row_occupied[x];
        }
      }
    }
  } else {
    const double c = std::cos(residual_yaw_rad) * seen.resolution / cell_m;
    const double s = std::sin(residual_yaw_rad) * seen.resolution / cell_m;
    // Neighbours mostly lie in the same bin: its sums are held until it changes.
    std::size_t bin = 0;
    double bin_weight = 0.0;
    double bin_occupied = 0.0;
    for (int iy = 0; iy < seen.size; ++iy) {
      for (int ix = 0; ix < seen.size; ++ix) {
        const double x = c * (ix - middle) - s * (iy - middle) + 0.5 * n;
        const double y = s * (ix - middle) + c * (iy - middle) + 0.5 * n;
        const std::size_t i = seen.index_of(ix, iy);
        if (x >= 0.0 && y >= 0.0 && x < n && y < n && counts(i)) {
          const auto here = static_cast<std::size_t>(static_cast<int>(y) * n + static_cast<int>(x));
          if (here != bin) {
            weight[bin] = bin_weight;
            occupied[bin] = bin_occupied;
            bin = here;
            bin_weight = weight[bin];
            bin_occupied = occupied[bin];
          }
          bin_weight += 1.0;
          bin_occupied += static_cast<double>(seen.occupancy[i]);
        }
      }
    }
    weight[bin] = bin_weight;
    occupied[bin] = bin_occupied;
  }
  std::vector<double> window(bins, 0.5);
  for (std::size_t i = 0; i < bins; ++i) {
    if (weight[i] > 0.0) {
      window[i] = occupied[i] / weight[i];
    }
  }
  return window;
}

OverlapModel::OverlapModel(const CoarseMap& map, const MeasurementModelParams& params)
    : params_{params}, map_{map} {
  likelihood_.is_by_neighbourhood = params.window_cells() == 3;
  const std::size_t count = likelihood_.is_by_neighbourhood
                                ? kNeighbourhoods
                                : Belief(map.width(), map.height()).padded_size();
  for (auto& values : likelihood_.values) {
    values.assign(count, 0.0);
  }
  const int reach = params.window_reach;
  for (int y = -reach; y < map.height() + reach && !likelihood_.is_by_neighbourhood; ++y) {
    for (int x = 0; x < map.width(); ++x) {
      std::uint32_t code = 0;
      for (int i = 0; i < params.window_cells(); ++i) {
        code |= (map.is_occupied({x - reach + i, y}) ? 1U : 0U) << static_cast<unsigned>(i);
      }
      row_codes_.push_back(code);
    }
  }
  const Belief layout{map.width(), map.height()};
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_free(c)) {
      free_cells_.push_back(
          {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(layout.padded_index(c))});
    }
  }
}

const Likelihood& OverlapModel::measure(const LocalOccupancy& seen, double residual_yaw_rad,
                                        double weight, const HeadingSet& headings) {
  const std::vector<double> window = reduce(seen, params_, residual_yaw_rad);
  for (const Heading h : kHeadings) {
    if (!headings[static_cast<std::size_t>(index(h))]) {
      continue;
    }
    if (likelihood_.is_by_neighbourhood) {
      fill_by_neighbourhood(window, h, weight * params_.exponent);
    } else {
      fill_by_cell(window, h, weight * params_.exponent);
    }
  }
  return likelihood_;
}

void OverlapModel::fill_by_neighbourhood(const std::vector<double>& window, Heading heading,
                                         double exponent) {
  // |m_hat - m| is m_hat where the map is free and 1 - m_hat where it is occupied: linear in the
  // map's bits.
  std::vector<double>& table = likelihood_.values[static_cast<std::size_t>(index(heading))];
  std::array<double, 9> by_bit{};
  double free_everywhere = 9.0;
  for (int w = 0; w < 9; ++w) {
    const double m_hat = window[static_cast<std::size_t>(w)];
    const Cell offset = in_map_axes(w, 3, heading);
    by_bit[static_cast<std::size_t>((offset.y + 1) * 3 + offset.x + 1)] = (2.0 * m_hat - 1.0) / 9.0;
    free_everywhere -= m_hat;
  }
  fill_subset_sums(free_everywhere / 9.0, by_bit.data(), 9, table.data());
  raise(table, exponent);
}

void OverlapModel::fill_by_cell(const std::vector<double>& window, Heading heading,
                                double exponent) {
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
  // The rows of the window, in parts of at most 9 bits.
  struct Part {
    std::size_t row;
    unsigned first_bit;
    std::array<double, kNeighbourhoods> sums;
  };
  std::vector<Part> parts;
  for (int row = 0; row < n; ++row) {
    for (int bit = 0; bit < n; bit += 9) {
      parts.push_back({static_cast<std::size_t>(row), static_cast<unsigned>(bit), {}});
      fill_subset_sums(parts.size() == 1 ? free_everywhere / (n * n) : 0.0,
                       by_bit.data() + row * n + bit, std::min(9, n - bit),
                       parts.back().sums.data());
    }
  }
  const auto width = static_cast<std::size_t>(map_.width());
  std::vector<double>& values = likelihood_.values[static_cast<std::size_t>(index(heading))];
  for (const FreeCell& cell : free_cells_) {
    const std::uint32_t* codes = row_codes_.data() + cell.index;
    double sum = 0.0;
    for (const Part& part : parts) {
      sum += part.sums[(codes[part.row * width] >> part.first_bit) % kNeighbourhoods];
    }
    values[cell.padded] = sum;
  }
  raise(values, exponent);
}

std::unique_ptr<MeasurementModel> make_measurement_model(const MeasurementModelParams& params,
                                                         const CoarseMap& map) {
  assert(params.type == "overlap");  // the parameter walk admits no other word
  return std::make_unique<OverlapModel>(map, params);
}

}  // namespace cmn
