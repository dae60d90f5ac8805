// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The networks that can be trained: ours and CMN's own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "folded_conv.hpp"
#include <torch/torch.h>

namespace cmn {

/// Logits of a batch. Rows run to the left, columns forward, as LocalOccupancy counts cells.
/// Channel 0: occupied; channel 1, of networks that state one: in sight.
struct Logits {
  torch::Tensor near;  ///< [n, 1 or 2, 128, 128]
  torch::Tensor wide;  ///< [n, 2, 64, 64]; undefined for networks that do not look that far
};

class PredictorNet : public torch::nn::Module {
 public:
  /// `panorama`: [n, 4, 3, 80, 80], views front, left, back, right; red, green, blue in [0, 1].
  virtual Logits forward(const torch::Tensor& panorama) = 0;
};

/// Features of the four views -> occupancy logits of one square.
class TopDownDecoderImpl : public torch::nn::Module {
 public:
  TopDownDecoderImpl(double side_m, int64_t coarse, int64_t fine);
  /// `coarse`: [4 n, c, distances, columns] of every view, `fine` likewise -> [n, 2, 64, 64].
  torch::Tensor forward(const torch::Tensor& coarse, const torch::Tensor& fine);

 private:
  torch::Tensor coarse_places_;  ///< where in a view's polar features a cell lies; constants
  torch::Tensor fine_places_;
  TurnConv first_;
  TurnConv second_;
  TurnConv narrow_;
  TurnConv joined_;
  TurnConv last_;
};
TORCH_MODULE(TopDownDecoder);

/// Ours: each view on its own becomes features over bearing and distance, which are laid out in
/// the view's quarter of the plane; what then joins them turns with the world, exactly.
///
/// Every column of a view is a bearing. A dense layer over the column's rows, the same for all
/// columns, gives features at 16 (and, from an earlier layer, past the deeper ones: 32) distances.
class WedgeNet : public PredictorNet {
 public:
  WedgeNet();
  Logits forward(const torch::Tensor& panorama) override;

 private:
  ConvNorm stem_;
  torch::nn::Sequential level1_;  ///< 20 rows, 20 columns
  torch::nn::Sequential level2_;  ///< 10 rows
  torch::nn::Sequential level3_;  ///< 5 rows
  ConvNorm coarse3_;
  ConvNorm coarse2_;
  ConvNorm fine_;
  TopDownDecoder near_;
  TopDownDecoder wide_;
};

/// CMN's own (section IV-B and the authors' released code): ResNet18 up to its mean over the image,
/// on the four views side by side; two 1 x 1 convolutions; 512 -> 1024 -> 4096 -> 64 x 8 x 8; four
/// transposed convolutions to 128 x 128. Departures: no weights from ImageNet, no dropout (its
/// share is not published).
class CmnNet : public PredictorNet {
 public:
  CmnNet();
  Logits forward(const torch::Tensor& panorama) override;

 private:
  ConvNorm stem_;
  torch::nn::Sequential trunk_;
  ConvNorm reduce1_;
  ConvNorm reduce2_;
  torch::nn::Linear dense1_;
  torch::nn::Linear dense2_;
  torch::nn::Sequential up_;
};

/// By the parameter's word: "wedge" or "cmn". Weights are drawn from torch's generator.
std::shared_ptr<PredictorNet> make_network(const std::string& network);

}  // namespace cmn
