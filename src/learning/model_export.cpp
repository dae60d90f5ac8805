// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model_export.hpp"

#include "coarse_map_nav/learning/torch_predictor.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <torch/csrc/jit/frontend/tracer.h>
#include <torch/script.h>

namespace cmn {
namespace {

/// The network with the same weights, folded.
std::shared_ptr<PredictorNet> folded_copy(const PredictorNet& net, const std::string& network) {
  const std::shared_ptr<PredictorNet> copy = make_network(network);
  torch::NoGradGuard no_gradient;
  const auto parameters = net.named_parameters();
  for (auto& item : copy->named_parameters()) {
    item.value().copy_(parameters[item.key()]);
  }
  const auto buffers = net.named_buffers();
  for (auto& item : copy->named_buffers()) {
    item.value().copy_(buffers[item.key()]);
  }
  copy->eval();
  for (torch::Tensor& parameter : copy->parameters()) {
    parameter.set_requires_grad(false);
  }
  for (const auto& module : copy->modules()) {
    if (auto* conv = dynamic_cast<FoldedConv*>(module.get())) {
      conv->fold();
    }
  }
  return copy;
}

/// Names of attributes have no dots.
std::string attribute_name(std::string path) {
  std::replace(path.begin(), path.end(), '.', '_');
  return path;
}

/// Hands the weights that a folded network uses to the module of the file.
void register_weights(PredictorNet& folded, torch::jit::Module& module) {
  for (const auto& item : folded.named_modules()) {
    const std::string prefix = attribute_name(item.key()) + "_";
    if (auto* conv = dynamic_cast<FoldedConv*>(item.value().get())) {
      module.register_parameter(prefix + "weight", conv->folded_weight, false);
      module.register_parameter(prefix + "bias", conv->folded_bias, false);
    } else if (item.value()->as<torch::nn::Linear>() != nullptr ||
               item.value()->as<torch::nn::ConvTranspose2d>() != nullptr) {
      for (const auto& weight : item.value()->named_parameters(false)) {
        module.register_parameter(prefix + weight.key(), weight.value(), false);
      }
    }
  }
}

/// What a file returns: probabilities, the confidence 1 where none is stated.
torch::IValue probabilities(const Logits& logits) {
  torch::Tensor near = torch::sigmoid(logits.near);
  if (near.size(1) == 1) {
    near = torch::cat({near, torch::ones_like(near)}, 1);
  }
  return logits.wide.defined() ? torch::IValue{std::make_tuple(near, torch::sigmoid(logits.wide))}
                               : torch::IValue{near};
}

}  // namespace

void export_model(const PredictorNet& net, const std::string& network, const std::string& path,
                  bool is_half) {
  const std::shared_ptr<PredictorNet> folded = folded_copy(net, network);
  torch::NoGradGuard no_gradient;
  torch::jit::Module module{"OccupancyPredictor"};
  register_weights(*folded, module);
  const torch::Tensor panorama = torch::rand({1, 4, 3, kViewSide, kViewSide});
  const auto traced = torch::jit::tracer::trace(
      {panorama},
      [&folded](torch::jit::Stack inputs) -> torch::jit::Stack {
        return {probabilities(folded->forward(inputs.at(0).toTensor()))};
      },
      [](const torch::Tensor&) { return std::string{}; }, /*strict=*/true,
      /*force_outplace=*/false, &module, {"panorama"});
  auto* forward = module._ivalue()->compilation_unit()->create_function(
      c10::QualifiedName{*module.type()->name(), "forward"}, traced.first->graph);
  module.type()->addMethod(forward);
  if (is_half) {
    module.to(torch::kHalf);
  }
  const std::string unfinished = path + ".part";
  try {
    module.save(unfinished);
    std::filesystem::rename(unfinished, path);
  } catch (const std::exception&) {
    throw std::runtime_error(path + ": cannot be written; does the folder exist?");
  }
}

void write_untrained_model(const std::string& path, const std::string& network, std::uint64_t seed,
                           bool is_half) {
  torch::manual_seed(seed);
  export_model(*make_network(network), network, path, is_half);
}

}  // namespace cmn
