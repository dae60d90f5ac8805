// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "folded_conv.hpp"

namespace cmn {
namespace {

/// What the normalisation does to a channel: times, then plus.
std::pair<torch::Tensor, torch::Tensor> affine_of(torch::nn::BatchNorm2d& norm) {
  const torch::Tensor scale = norm->weight * torch::rsqrt(norm->running_var + norm->options.eps());
  return {scale, norm->bias - norm->running_mean * scale};
}

}  // namespace

ConvNormImpl::ConvNormImpl(const ConvShape& shape)
    : shape_{shape},
      conv_{register_module(
          "conv", torch::nn::Conv2d{torch::nn::Conv2dOptions(shape.in, shape.out, shape.kernel)
                                        .stride(shape.stride)
                                        .padding(shape.kernel / 2)
                                        .bias(false)})},
      norm_{register_module("norm", torch::nn::BatchNorm2d{shape.out})} {
  torch::nn::init::kaiming_normal_(conv_->weight, 0.0, torch::kFanOut, torch::kReLU);
}

torch::Tensor ConvNormImpl::forward(const torch::Tensor& x) {
  return folded_weight.defined()
             ? torch::conv2d(x, folded_weight, folded_bias, shape_.stride, shape_.kernel / 2)
             : norm_(conv_(x));
}

void ConvNormImpl::fold() {
  const auto [scale, shift] = affine_of(norm_);
  folded_weight = (conv_->weight * scale.view({-1, 1, 1, 1})).detach();
  folded_bias = shift.detach();
}

TurnConvImpl::TurnConvImpl(int64_t in, int64_t out, int64_t kernel, bool is_last)
    : out_{out}, size_{kernel} {
  // As many inputs flow into a cell as into one of a plain convolution of 4 * in channels.
  const double deviation = std::sqrt(2.0 / static_cast<double>(4 * in * kernel * kernel));
  weight_ = register_parameter("weight", torch::randn({out, 4, in, kernel, kernel}) * deviation);
  if (is_last) {
    bias_ = register_parameter("bias", torch::zeros({out}));
  } else {
    norm_ = register_module("norm", torch::nn::BatchNorm2d{out});
  }
}

torch::Tensor TurnConvImpl::kernel() const {
  std::vector<torch::Tensor> turns;
  for (int64_t g = 0; g < 4; ++g) {
    // Rows run to the left and columns forward: a left turn takes the column axis to the row axis.
    turns.push_back(torch::rot90(torch::roll(weight_, g, 1), g, {4, 3}));
  }
  const torch::Tensor all = torch::stack(turns);
  return all.reshape({4 * out_, 4 * weight_.size(2), size_, size_});
}

torch::Tensor TurnConvImpl::forward(const torch::Tensor& x) {
  if (folded_weight.defined()) {
    return torch::conv2d(x, folded_weight, folded_bias, 1, size_ / 2);
  }
  const torch::Tensor y = torch::conv2d(x, kernel(), {}, 1, size_ / 2);
  // All turns share one normalisation and one bias.
  const torch::Tensor by_turn = y.reshape({-1, out_, y.size(2), y.size(3)});
  const torch::Tensor z = norm_.is_empty() ? by_turn + bias_.view({1, -1, 1, 1}) : norm_(by_turn);
  return z.reshape(y.sizes());
}

void TurnConvImpl::fold() {
  if (norm_.is_empty()) {
    folded_weight = kernel().detach();
    folded_bias = bias_.repeat({4}).detach();
    return;
  }
  const auto [scale, shift] = affine_of(norm_);
  folded_weight = (kernel() * scale.repeat({4}).view({-1, 1, 1, 1})).detach();
  folded_bias = shift.repeat({4}).detach();
}

ResidualImpl::ResidualImpl(int64_t in, int64_t out, torch::ExpandingArray<2> stride)
    : first_{register_module("first", ConvNorm{ConvShape{in, out, 3, stride}})},
      second_{register_module("second", ConvNorm{ConvShape{out, out, 3, 1}})} {
  if (in != out || (*stride)[0] != 1 || (*stride)[1] != 1) {
    around_ = register_module("around", ConvNorm{ConvShape{in, out, 1, stride}});
  }
}

torch::Tensor ResidualImpl::forward(const torch::Tensor& x) {
  const torch::Tensor around = around_.is_empty() ? x : around_(x);
  return torch::relu(second_(torch::relu(first_(x))) + around);
}

}  // namespace cmn
