// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
// Stands in for the rest of this folder where LibTorch or HDF5 is absent: whoever asks is told.
#include "coarse_map_nav/learning/torch_predictor.hpp"
#include "coarse_map_nav/learning/training.hpp"

#include <stdexcept>

namespace cmn {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error("this build has no networks: " CMN_LEARNING_ABSENT);
}

}  // namespace

struct ExampleFile::Hdf5 {};
ExampleFile::ExampleFile(const std::string&) { fail(); }
ExampleFile::ExampleFile(ExampleFile&&) noexcept = default;
ExampleFile& ExampleFile::operator=(ExampleFile&&) noexcept = default;
ExampleFile::~ExampleFile() = default;
std::uint32_t ExampleFile::house_seed() const { fail(); }
std::size_t ExampleFile::size() const { fail(); }
Example ExampleFile::read(std::size_t) const { fail(); }
void write_examples(const std::string&, std::uint32_t, const std::vector<Example>&) { fail(); }

std::unique_ptr<OccupancyPredictor> load_predictor(const std::string&, const PredictorOptions&) {
  fail();
}
void write_untrained_model(const std::string&, const std::string&, std::uint64_t, bool) { fail(); }

TrainingOutcome train(const TrainingJob&) { fail(); }
PredictionScores evaluate_predictor(OccupancyPredictor&, ExampleSet&, std::size_t, std::uint64_t) {
  fail();
}

}  // namespace cmn
