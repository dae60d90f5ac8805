// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/torch_predictor.hpp"

#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tensors.hpp"
#include <ATen/Parallel.h>
#include <torch/script.h>

namespace cmn {
namespace {

/// The first calls record and optimise.
constexpr int kWarmUpRuns = 3;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

/// Torch's own words, without where in its sources they were said.
std::string first_line(const std::exception& error) {
  const auto* torch_error = dynamic_cast<const c10::Error*>(&error);
  const std::string text =
      torch_error != nullptr ? torch_error->what_without_backtrace() : error.what();
  return text.substr(0, text.find('\n'));
}

torch::jit::Module load_module(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    fail(path, "there is no such file");
  }
  try {
    torch::jit::Module module = torch::jit::load(path, torch::kCPU);
    module.to(torch::kFloat);
    module.eval();
    return module;
  } catch (const std::exception& e) {
    fail(path, "is no TorchScript file, or is damaged: " + first_line(e));
  }
}

void check_signature(const torch::jit::Module& module, const std::string& path) {
  const auto method = module.find_method("forward");
  if (!method) {
    fail(path, "has no method \"forward\"");
  }
  const std::size_t inputs = method->num_inputs() - 1;  // without self
  if (inputs != 1) {
    fail(path, "its forward takes " + std::to_string(inputs) +
                   " inputs, not 1: the panorama [1, 4, 3, 80, 80]");
  }
}

std::string shape_text(const torch::Tensor& tensor) {
  std::ostringstream text;
  text << tensor.sizes();
  return text.str();
}

/// The float square [2, size, size] of an output; a confidence that is not stated is 1.
torch::Tensor checked_square(const torch::IValue& output, int size, const char* what) {
  if (!output.isTensor()) {
    throw std::runtime_error(std::string{"its output "} + what + " is no tensor");
  }
  const torch::Tensor square = output.toTensor();
  const bool fits = square.dim() == 4 && square.size(0) == 1 &&
                    (square.size(1) == 1 || square.size(1) == 2) && square.size(2) == size &&
                    square.size(3) == size;
  if (!fits || square.scalar_type() != torch::kFloat) {
    const std::string side = std::to_string(size);
    throw std::runtime_error(std::string{"its output "} + what + " is " + square.toString() + " " +
                             shape_text(square) + ", not float [1, 1 or 2, " + side + ", " + side +
                             "]");
  }
  return square.size(1) == 2 ? square[0] : torch::cat({square[0], torch::ones_like(square[0])});
}

struct Squares {
  torch::Tensor near;
  std::optional<torch::Tensor> wide;
};

/// Throws std::runtime_error saying what is wrong with the output.
Squares squares_of(const torch::IValue& output) {
  if (!output.isTuple()) {
    return {checked_square(output, kNearSize, "near"), std::nullopt};
  }
  const auto& elements = output.toTupleRef().elements();
  if (elements.size() != 2) {
    throw std::runtime_error("it returns " + std::to_string(elements.size()) +
                             " values, not near or (near, wide)");
  }
  return {checked_square(elements[0], kNearSize, "near"),
          checked_square(elements[1], kWideSize, "wide")};
}

/// Throws std::runtime_error when a value is no probability.
void check_range(const torch::Tensor& square, const char* what) {
  if (!((square >= 0.0) & (square <= 1.0)).all().item<bool>()) {
    throw std::runtime_error(std::string{"its output "} + what +
                             " is not within [0, 1]; is the sigmoid missing?");
  }
}

class TorchPredictor : public OccupancyPredictor {
 public:
  TorchPredictor(const std::string& path, const PredictorOptions& options)
      : path_{path}, module_{load_module(path)} {
    at::set_num_threads(options.threads);
    check_signature(module_, path);
    try {
      if (options.is_frozen) {
        module_ = torch::jit::freeze(module_);
      }
      for (int i = 0; i < kWarmUpRuns; ++i) {
        const Squares squares = run(ColorPanorama{});
        check_range(squares.near, "near");
        if (squares.wide) {
          check_range(*squares.wide, "wide");
        }
      }
    } catch (const std::exception& e) {
      fail(path_, first_line(e));
    }
  }

  PredictedOccupancy predict(const ColorPanorama& panorama) override {
    try {
      const Squares squares = run(panorama);
      PredictedOccupancy predicted;
      predicted.near = local_occupancy(squares.near, kNearSide_m, panorama.stamp_s);
      if (squares.wide) {
        predicted.wide = local_occupancy(*squares.wide, kWideSide_m, panorama.stamp_s);
      }
      return predicted;
    } catch (const std::exception& e) {
      fail(path_, first_line(e));
    }
  }

 private:
  Squares run(const ColorPanorama& panorama) {
    const torch::InferenceMode no_gradient;
    return squares_of(module_.forward({panoramas_tensor({panorama})}));
  }

  std::string path_;
  torch::jit::Module module_;
};

}  // namespace

std::unique_ptr<OccupancyPredictor> load_predictor(const std::string& path,
                                                   const PredictorOptions& options) {
  return std::make_unique<TorchPredictor>(path, options);
}

}  // namespace cmn
