// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Convolutions with batch normalisation that fold into plain ones for a shipped model.
#pragma once

#include <torch/torch.h>

namespace cmn {

/// A convolution whose kernel may be fixed: folded, it is one kernel and one bias.
class FoldedConv {
 public:
  virtual ~FoldedConv() = default;
  /// Works out kernel and bias once, normalisation included; what is trained later has no effect.
  virtual void fold() = 0;
  torch::Tensor folded_weight;
  torch::Tensor folded_bias;
};

struct ConvShape {
  int64_t in = 0;
  int64_t out = 0;
  int64_t kernel = 3;
  torch::ExpandingArray<2> stride = 1;
};

/// Convolution without bias, padded to keep the size, then batch normalisation.
class ConvNormImpl : public torch::nn::Module, public FoldedConv {
 public:
  explicit ConvNormImpl(const ConvShape& shape);
  torch::Tensor forward(const torch::Tensor& x);
  void fold() override;

 private:
  ConvShape shape_;
  torch::nn::Conv2d conv_;
  torch::nn::BatchNorm2d norm_;
};
TORCH_MODULE(ConvNorm);

/// A convolution over the plane and over the four quarter turns (Cohen and Welling 2016, group p4),
/// then, unless it is the last, batch normalisation.
///
/// Features are [n, 4 * in, h, w], the turn changing slowest: channels of turn k are what the
/// network saw with the world turned by k. When the input turns, the output turns with it:
/// y[g](x) = sum over h, u of psi[(h - g) mod 4](turned back by g: u) f[h](x + u).
class TurnConvImpl : public torch::nn::Module, public FoldedConv {
 public:
  TurnConvImpl(int64_t in, int64_t out, int64_t kernel, bool is_last);
  torch::Tensor forward(const torch::Tensor& x);
  void fold() override;

 private:
  /// psi for every pair of turns, as one plain kernel: [4 * out, 4 * in, k, k].
  torch::Tensor kernel() const;

  int64_t out_;
  int64_t size_;
  torch::Tensor weight_;  ///< psi: [out, 4, in, k, k]
  torch::Tensor bias_;    ///< of the last one: [out]
  torch::nn::BatchNorm2d norm_{nullptr};
};
TORCH_MODULE(TurnConv);

/// Two convolutions and a way around them (He et al. 2016).
class ResidualImpl : public torch::nn::Module {
 public:
  ResidualImpl(int64_t in, int64_t out, torch::ExpandingArray<2> stride);
  torch::Tensor forward(const torch::Tensor& x);

 private:
  ConvNorm first_;
  ConvNorm second_;
  ConvNorm around_{nullptr};
};
TORCH_MODULE(Residual);

}  // namespace cmn
