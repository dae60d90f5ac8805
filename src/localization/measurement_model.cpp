// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/measurement_model.hpp"

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/localization/neighbourhood.hpp"

#include <cassert>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

double power(double base, double exponent) {
  return exponent == 1.0 ? base : exponent == 2.0 ? base * base : std::pow(base, exponent);
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

  // A fine cell covers parts of up to 2 x 2 coarse ones; its share along each axis.
  struct Share {
    int bin;
    double part;
  };
  const double half_fine = residual_yaw_rad == 0.0 ? 0.5 * seen.resolution : 0.0;
  const auto shares = [&](double center_m) {
    const double low = (center_m - half_fine) / cell_m + 0.5 * n;
    const double high = (center_m + half_fine) / cell_m + 0.5 * n;
    const int first = static_cast<int>(std::floor(low));
    const double border = first + 1.0;
    const double part = high <= border ? 1.0 : (border - low) / (high - low);
    return std::array<Share, 2>{Share{first, part}, Share{first + 1, 1.0 - part}};
  };
  const auto add = [&](const std::array<Share, 2>& xs, const std::array<Share, 2>& ys,
                       double value) {
    for (const Share& y : ys) {
      for (const Share& x : xs) {
        const double part = x.part * y.part;
        if (part > 0.0 && x.bin >= 0 && y.bin >= 0 && x.bin < n && y.bin < n) {
          const auto bin = static_cast<std::size_t>(y.bin * n + x.bin);
          weight[bin] += part;
          occupied[bin] += part * value;
        }
      }
    }
  };

  const double c = std::cos(residual_yaw_rad);
  const double s = std::sin(residual_yaw_rad);
  const double middle = 0.5 * (seen.size - 1);
  std::vector<std::array<Share, 2>> columns;
  for (int ix = 0; ix < seen.size; ++ix) {
    columns.push_back(shares((ix - middle) * seen.resolution));
  }
  for (int iy = 0; iy < seen.size; ++iy) {
    const auto row = columns[static_cast<std::size_t>(iy)];
    for (int ix = 0; ix < seen.size; ++ix) {
      const std::size_t i = seen.index_of(ix, iy);
      const bool is_unseen = seen.confidence[i] <= 0.0F;
      if (is_unseen && !params.unseen_is_occupied) {
        continue;
      }
      const double value = static_cast<double>(seen.occupancy[i]);
      if (residual_yaw_rad == 0.0) {
        add(columns[static_cast<std::size_t>(ix)], row, value);
      } else {
        const double x = (ix - middle) * seen.resolution;
        const double y = (iy - middle) * seen.resolution;
        add(shares(c * x - s * y), shares(s * x + c * y), value);
      }
    }
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
                                ? std::tuple_size<NeighbourhoodTable>::value
                                : Belief(map.width(), map.height()).padded_size();
  for (auto& values : likelihood_.values) {
    values.assign(count, 0.0);
  }
}

const Likelihood& OverlapModel::measure(const LocalOccupancy& seen, double residual_yaw_rad,
                                        double weight) {
  const std::vector<double> window = reduce(seen, params_, residual_yaw_rad);
  for (const Heading h : kHeadings) {
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
  // map's bits, so each code follows from the one without its highest bit.
  std::vector<double>& table = likelihood_.values[static_cast<std::size_t>(index(heading))];
  std::array<double, 9> by_bit{};
  double free_everywhere = 9.0;
  for (int w = 0; w < 9; ++w) {
    const double m_hat = window[static_cast<std::size_t>(w)];
    const Cell offset = in_map_axes(w, 3, heading);
    by_bit[static_cast<std::size_t>((offset.y + 1) * 3 + offset.x + 1)] = (2.0 * m_hat - 1.0) / 9.0;
    free_everywhere -= m_hat;
  }
  table[0] = free_everywhere / 9.0;
  for (std::size_t bit = 0; bit < 9; ++bit) {
    const std::size_t first = std::size_t{1} << bit;
    for (std::size_t code = first; code < 2 * first; ++code) {
      table[code] = table[code - first] + by_bit[bit];
    }
  }
  for (double& likelihood : table) {
    // The sums above may leave -1e-17 where 0 is meant.
    likelihood = power(likelihood > 1e-15 ? likelihood : 0.0, exponent);
  }
}

void OverlapModel::fill_by_cell(const std::vector<double>& window, Heading heading,
                                double exponent) {
  const int n = params_.window_cells();
  cv::Mat kernel(n, n, CV_64F);
  double free_everywhere = n * n;
  for (int w = 0; w < n * n; ++w) {
    const double m_hat = window[static_cast<std::size_t>(w)];
    const Cell offset = in_map_axes(w, n, heading);
    kernel.at<double>(offset.y + n / 2, offset.x + n / 2) = (2.0 * m_hat - 1.0) / (n * n);
    free_everywhere -= m_hat;
  }
  cv::Mat occupied;
  cv::Mat(map_.height(), map_.width(), CV_8U,
          const_cast<std::uint8_t*>(map_.occupied().values().data()))
      .convertTo(occupied, CV_64F);
  cv::Mat padded;
  cv::copyMakeBorder(occupied, padded, n, n, n, n, cv::BORDER_CONSTANT, 1.0);
  cv::Mat likelihood;
  cv::filter2D(padded, likelihood, CV_64F, kernel, cv::Point(-1, -1), free_everywhere / (n * n),
               cv::BORDER_CONSTANT);
  const Belief layout{map_.width(), map_.height()};
  std::vector<double>& values = likelihood_.values[static_cast<std::size_t>(index(heading))];
  for (int y = 0; y < map_.height(); ++y) {
    for (int x = 0; x < map_.width(); ++x) {
      const double value = likelihood.at<double>(y + n, x + n);
      values[layout.padded_index({x, y})] = power(value > 1e-15 ? value : 0.0, exponent);
    }
  }
}

std::unique_ptr<MeasurementModel> make_measurement_model(const MeasurementModelParams& params,
                                                         const CoarseMap& map) {
  assert(params.type == "overlap");  // the parameter walk admits no other word
  return std::make_unique<OverlapModel>(map, params);
}

}  // namespace cmn
