// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "networks.hpp"

#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <cmath>
#include <stdexcept>

namespace cmn {
namespace {

namespace F = torch::nn::functional;

constexpr int64_t kCoarse = 8;            ///< channels of each view's polar features ...
constexpr int64_t kFine = 3;              ///< ... and of those past the deeper layers
constexpr int64_t kCoarseDistances = 16;  ///< bins
constexpr int64_t kFineDistances = 32;
constexpr int64_t kColumns = 20;

/// Distance [m] -> [0, 1]: near bins are thinner, as rows of an image are on the floor.
double distance_share(double distance_m) {
  constexpr double kFarthest_m = 2.3;  // the corner of the wide square
  constexpr double kBend = 11.0;
  return std::log1p(kBend * distance_m / kFarthest_m) / std::log1p(kBend);
}

/// Where a view's polar features (columns: from its left to its right border; rows: distance) hold
/// the cells of a square, for grid_sample: [1, cells, cells, 2] in [-1, 1]. Cells out of the view
/// lie outside.
torch::Tensor polar_places(double side_m, int64_t cells) {
  torch::Tensor places = torch::empty({1, cells, cells, 2});
  auto at = places.accessor<float, 4>();
  for (int64_t iy = 0; iy < cells; ++iy) {
    for (int64_t ix = 0; ix < cells; ++ix) {
      const double x =
          ((static_cast<double>(ix) + 0.5) / static_cast<double>(cells) - 0.5) * side_m;
      const double y =
          ((static_cast<double>(iy) + 0.5) / static_cast<double>(cells) - 0.5) * side_m;
      // A pinhole of 90 degrees: its borders are where |y| = x.
      const bool is_ahead = x > 0.0 && std::abs(y) < 1.5 * x;
      at[0][iy][ix][0] = is_ahead ? static_cast<float>(-y / x) : -3.0F;
      at[0][iy][ix][1] = static_cast<float>(2.0 * distance_share(std::hypot(x, y)) - 1.0);
    }
  }
  return places;
}

/// Polar features of the four views -> their places in the plane, view k turned to where it looks:
/// [4 n, c, d, w] -> [n, 4 c, cells, cells].
torch::Tensor laid_out(const torch::Tensor& polar, const torch::Tensor& places) {
  const torch::Tensor grid = places.to(polar.device()).expand({polar.size(0), -1, -1, -1});
  const torch::Tensor ahead = torch::grid_sampler(polar, grid, /*interpolation_mode=*/0,
                                                  /*padding_mode=*/0, /*align_corners=*/false);
  const torch::Tensor by_view = ahead.view({-1, 4, ahead.size(1), ahead.size(2), ahead.size(3)});
  std::vector<torch::Tensor> turned;
  for (int64_t k = 0; k < 4; ++k) {
    turned.push_back(torch::rot90(by_view.select(1, k), k, {3, 2}));
  }
  return torch::cat(turned, 1);
}

/// Channels of [n, c, rows, columns] and its rows together become those of one row, which a 1 x 1
/// convolution then mixes: a dense layer over each column.
torch::Tensor columns_of(const torch::Tensor& x) {
  return x.reshape({x.size(0), x.size(1) * x.size(2), 1, x.size(3)});
}
torch::Tensor as_polar(const torch::Tensor& x, int64_t channels) {
  return x.reshape({x.size(0), channels, -1, x.size(3)});
}

torch::Tensor twice_as_large(const torch::Tensor& x) {
  return torch::upsample_bilinear2d(x, {2 * x.size(2), 2 * x.size(3)}, /*align_corners=*/false);
}

torch::nn::Sequential two_residuals(int64_t in, int64_t out, torch::ExpandingArray<2> stride) {
  return torch::nn::Sequential{Residual{in, out, stride}, Residual{out, out, 1}};
}

torch::nn::ConvTranspose2d doubling(int64_t in, int64_t out) {
  return torch::nn::ConvTranspose2d{
      torch::nn::ConvTranspose2dOptions(in, out, 4).stride(2).padding(1)};
}

}  // namespace

TopDownDecoderImpl::TopDownDecoderImpl(double side_m, int64_t coarse, int64_t fine)
    : coarse_places_{polar_places(side_m, kWideSize / 2)},
      fine_places_{polar_places(side_m, kWideSize)},
      first_{register_module("first", TurnConv{coarse, coarse, 3, false})},
      second_{register_module("second", TurnConv{coarse, coarse, 3, false})},
      narrow_{register_module("narrow", TurnConv{coarse, coarse / 2, 1, false})},
      joined_{register_module("joined", TurnConv{coarse / 2 + fine, coarse / 2, 3, false})},
      last_{register_module("last", TurnConv{coarse / 2, 2, 3, true})} {}

torch::Tensor TopDownDecoderImpl::forward(const torch::Tensor& coarse, const torch::Tensor& fine) {
  const torch::Tensor plane = laid_out(coarse, coarse_places_);
  const torch::Tensor mixed = torch::relu(second_(torch::relu(first_(plane))) + plane);
  const torch::Tensor large = twice_as_large(torch::relu(narrow_(mixed)));
  // By turn: each turn's channels of both stay together.
  const auto by_turn = [](const torch::Tensor& x) {
    return x.reshape({x.size(0), 4, -1, x.size(2), x.size(3)});
  };
  const torch::Tensor skipped = laid_out(fine, fine_places_);
  const torch::Tensor both = torch::cat({by_turn(large), by_turn(skipped)}, 2).flatten(1, 2);
  return by_turn(last_(torch::relu(joined_(both)))).mean(1);
}

WedgeNet::WedgeNet()
    : stem_{register_module("stem", ConvNorm{ConvShape{3, 12, 5, 2}})},
      level1_{register_module("level1", two_residuals(12, 16, 2))},
      level2_{register_module("level2", two_residuals(16, 32, {2, 1}))},
      level3_{register_module("level3", two_residuals(32, 48, {2, 1}))},
      coarse3_{register_module("coarse3",
                               ConvNorm{ConvShape{48 * 5, kCoarse * kCoarseDistances, 1, 1}})},
      coarse2_{register_module("coarse2",
                               ConvNorm{ConvShape{32 * 10, kCoarse * kCoarseDistances, 1, 1}})},
      fine_{register_module("fine",
                            ConvNorm{ConvShape{16 * kColumns, kFine * kFineDistances, 1, 1}})},
      near_{register_module("near", TopDownDecoder{kNearSide_m, kCoarse, kFine})},
      wide_{register_module("wide", TopDownDecoder{kWideSide_m, kCoarse, kFine})} {}

Logits WedgeNet::forward(const torch::Tensor& panorama) {
  const torch::Tensor level1 = level1_->forward(torch::relu(stem_(panorama.flatten(0, 1))));
  const torch::Tensor level2 = level2_->forward(level1);
  const torch::Tensor level3 = level3_->forward(level2);
  const torch::Tensor coarse =
      as_polar(torch::relu(coarse3_(columns_of(level3)) + coarse2_(columns_of(level2))), kCoarse);
  const torch::Tensor fine = as_polar(torch::relu(fine_(columns_of(level1))), kFine);
  return {twice_as_large(near_(coarse, fine)), wide_(coarse, fine)};
}

CmnNet::CmnNet()
    : stem_{register_module("stem", ConvNorm{ConvShape{3, 64, 7, 2}})},
      trunk_{register_module(
          "trunk",
          torch::nn::Sequential{Residual{64, 64, 1}, Residual{64, 64, 1}, Residual{64, 128, 2},
                                Residual{128, 128, 1}, Residual{128, 256, 2}, Residual{256, 256, 1},
                                Residual{256, 512, 2}, Residual{512, 512, 1}})},
      reduce1_{register_module("reduce1", ConvNorm{ConvShape{512, 512, 1, 1}})},
      reduce2_{register_module("reduce2", ConvNorm{ConvShape{512, 512, 1, 1}})},
      dense1_{register_module("dense1", torch::nn::Linear{512, 1024})},
      dense2_{register_module("dense2", torch::nn::Linear{1024, 4096})},
      up_{register_module(
          "up", torch::nn::Sequential{
                    doubling(64, 64), torch::nn::ReLU{}, doubling(64, 32), torch::nn::ReLU{},
                    doubling(32, 32), torch::nn::ReLU{}, doubling(32, 16), torch::nn::ReLU{},
                    torch::nn::ConvTranspose2d{torch::nn::ConvTranspose2dOptions(16, 1, 1)}})} {}

Logits CmnNet::forward(const torch::Tensor& panorama) {
  const torch::Tensor strip =
      panorama.permute({0, 2, 3, 1, 4}).reshape({-1, 3, kViewSide, 4 * kViewSide});
  const torch::Tensor stem = torch::max_pool2d(torch::relu(stem_(strip)), 3, 2, 1);
  const torch::Tensor mean = trunk_->forward(stem).mean({2, 3}, true);
  const torch::Tensor reduced = torch::relu(reduce2_(torch::relu(reduce1_(mean)))).flatten(1);
  const torch::Tensor dense = torch::relu(dense2_(torch::relu(dense1_(reduced))));
  return {up_->forward(dense.view({-1, 64, 8, 8})), {}};
}

std::shared_ptr<PredictorNet> make_network(const std::string& network) {
  if (network == "wedge") {
    return std::make_shared<WedgeNet>();
  }
  if (network == "cmn") {
    return std::make_shared<CmnNet>();
  }
  throw std::runtime_error("there is no network \"" + network + "\"; wedge or cmn");
}

}  // namespace cmn
