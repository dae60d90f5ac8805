// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What seeing local occupancy in a colour panorama costs; the weights do not matter.
#include "coarse_map_nav/learning/torch_predictor.hpp"

#include <exception>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

namespace cmn {
namespace {

ColorPanorama noise() {
  cv::RNG rng{1};
  ColorPanorama panorama;
  for (cv::Mat& view : panorama.views) {
    rng.fill(view, cv::RNG::UNIFORM, 0, 256);
  }
  return panorama;
}

void panorama_to_occupancy(benchmark::State& state, const std::string& network, bool is_half,
                           const PredictorOptions& options) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "cmn_learning_benchmark.pt").string();
  try {
    write_untrained_model(path, network, 1, is_half);
    const auto predictor = load_predictor(path, options);
    const ColorPanorama panorama = noise();
    for (auto _ : state) {
      benchmark::DoNotOptimize(predictor->predict(panorama));
    }
  } catch (const std::exception& e) {
    state.SkipWithError(e.what());
  }
  std::filesystem::remove(path);
}

void add(const std::string& network, const std::string& weights, int threads, bool is_frozen) {
  const std::string name = "panorama_to_occupancy/" + network + "/" + weights +
                           "/threads:" + std::to_string(threads) +
                           (is_frozen ? "/frozen" : "/eager");
  const PredictorOptions options{threads, is_frozen};
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) {
                                 panorama_to_occupancy(state, network, weights == "half", options);
                               })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

}  // namespace
}  // namespace cmn

int main(int argc, char** argv) {
  for (const char* network : {"wedge", "cmn"}) {
    cmn::add(network, "float", 1, true);
    cmn::add(network, "float", 1, false);
    cmn::add(network, "half", 1, true);
    cmn::add(network, "float", 2, true);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
