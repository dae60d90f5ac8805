// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A predictor whose rule can be seen through: no network.
#pragma once

#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <cmath>

namespace cmn {

/// Where view k is not black, its quarter of both squares is in sight, and occupied from as many
/// decimetres on as the middle pixel's red says.
class FakePredictor : public OccupancyPredictor {
 public:
  PredictedOccupancy predict(const ColorPanorama& panorama) override {
    ++predictions;
    PredictedOccupancy predicted;
    predicted.near = square_of(panorama, kNearSize, kNearSide_m);
    predicted.wide = square_of(panorama, kWideSize, kWideSide_m);
    return predicted;
  }

  int predictions = 0;

 private:
  static LocalOccupancy square_of(const ColorPanorama& panorama, int size, double side_m) {
    LocalOccupancy square{size, side_m / size};
    square.stamp_s = panorama.stamp_s;
    square.source = ObservationSource::kRgb;
    for (int iy = 0; iy < size; ++iy) {
      for (int ix = 0; ix < size; ++ix) {
        const double x = (ix + 0.5 - 0.5 * size) * square.resolution;
        const double y = (iy + 0.5 - 0.5 * size) * square.resolution;
        const auto view = static_cast<std::size_t>((nearest_quarter(std::atan2(y, x)) + 4) % 4);
        const int red = panorama.views[view].at<cv::Vec3b>(kViewSide / 2, kViewSide / 2)[2];
        const std::size_t i = square.index_of(ix, iy);
        square.confidence[i] = red > 0 ? 0.99F : 0.01F;
        square.occupancy[i] = std::hypot(x, y) < 0.1 * red ? 0.01F : 0.99F;
      }
    }
    return square;
  }
};

}  // namespace cmn
