// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/torch_predictor.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "file_fixture.hpp"
#include "learning_examples.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

ColorPanorama noise(std::uint64_t seed) {
  cv::RNG rng{seed + 1};
  ColorPanorama panorama;
  panorama.stamp_s = 12.5;
  for (cv::Mat& view : panorama.views) {
    rng.fill(view, cv::RNG::UNIFORM, 0, 256);
  }
  return panorama;
}

float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  float largest = a.size() == b.size() ? 0.0F : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// The same, as a robot sees it that has turned left.
LocalOccupancy after_left_turn(const LocalOccupancy& seen) {
  LocalOccupancy result = seen;
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const std::size_t from = seen.index_of(seen.size - 1 - iy, ix);
      result.occupancy[result.index_of(ix, iy)] = seen.occupancy[from];
      result.confidence[result.index_of(ix, iy)] = seen.confidence[from];
    }
  }
  return result;
}

std::string untrained(const std::string& network, std::uint64_t seed = 1, bool is_half = false) {
  const std::string path = fresh_folder(network) + "/model.pt";
  write_untrained_model(path, network, seed, is_half);
  return path;
}

TEST(TorchPredictor, PredictsBothSquaresAsProbabilities) {
  const auto predictor = load_predictor(untrained("wedge"));
  const PredictedOccupancy predicted = predictor->predict(noise(1));
  ASSERT_TRUE(predicted.wide.has_value());
  EXPECT_EQ(predicted.near.size, 128);
  EXPECT_DOUBLE_EQ(predicted.near.side_m(), 1.28);
  EXPECT_EQ(predicted.wide->size, 64);
  EXPECT_DOUBLE_EQ(predicted.wide->side_m(), 3.2);
  EXPECT_EQ(predicted.near.stamp_s, 12.5);
  EXPECT_EQ(predicted.near.source, ObservationSource::kRgb);
  EXPECT_THAT(predicted.near.occupancy,
              ::testing::Each(AllOf(::testing::Ge(0.0F), ::testing::Le(1.0F))));
  EXPECT_GT(
      largest_difference(predicted.near.occupancy, predictor->predict(noise(2)).near.occupancy),
      0.0F)
      << "blind";
}

TEST(TorchPredictor, TheWedgeNetTurnsItsPredictionWithTheWorld) {
  const auto predictor = load_predictor(untrained("wedge"));
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PredictedOccupancy before = predictor->predict(noise(seed));
    const PredictedOccupancy after = predictor->predict(turned(noise(seed), 1));
    const LocalOccupancy near = after_left_turn(before.near);
    const LocalOccupancy wide = after_left_turn(*before.wide);
    EXPECT_GT(largest_difference(before.near.occupancy, after.near.occupancy), 0.01F);
    EXPECT_LT(largest_difference(near.occupancy, after.near.occupancy), 1e-4F);
    EXPECT_LT(largest_difference(near.confidence, after.near.confidence), 1e-4F);
    EXPECT_LT(largest_difference(wide.occupancy, after.wide->occupancy), 1e-4F);
  }
}

TEST(TorchPredictor, CmnsOwnNetworkHasNoWideSquareAndStatesNoConfidence) {
  const auto predictor = load_predictor(untrained("cmn"));
  const PredictedOccupancy predicted = predictor->predict(noise(1));
  EXPECT_FALSE(predicted.wide.has_value());
  EXPECT_THAT(predicted.near.confidence, ::testing::Each(1.0F));
}

TEST(TorchPredictor, IsTheSameFrozenOrNotAndNearlyTheSameInHalfPrecision) {
  const ColorPanorama seen = noise(3);
  PredictorOptions eager;
  eager.is_frozen = false;
  const PredictedOccupancy frozen = load_predictor(untrained("wedge"))->predict(seen);
  const PredictedOccupancy thawed = load_predictor(untrained("wedge"), eager)->predict(seen);
  const PredictedOccupancy half = load_predictor(untrained("wedge", 1, true))->predict(seen);
  const PredictedOccupancy other = load_predictor(untrained("wedge", 2))->predict(seen);
  EXPECT_LT(largest_difference(frozen.near.occupancy, thawed.near.occupancy), 1e-4F);
  EXPECT_LT(largest_difference(frozen.near.occupancy, half.near.occupancy), 0.02F);
  EXPECT_GT(largest_difference(frozen.near.occupancy, other.near.occupancy), 0.02F);
}

TEST(TorchPredictor, HalfPrecisionHalvesTheFile) {
  const auto size = [](const std::string& path) {
    return static_cast<double>(std::filesystem::file_size(path));
  };
  const double whole = size(untrained("cmn"));
  const double half = size(untrained("cmn", 1, true));
  EXPECT_NEAR(half / whole, 0.5, 0.02);
}

TEST(TorchPredictor, NamesFilesThatAreNone) {
  EXPECT_THAT(error_of([] { load_predictor("/nowhere/model.pt"); }),
              HasSubstr("/nowhere/model.pt: there is no such file"));
  const std::string garbage = file_with("garbage.pt", "PK garbage");
  EXPECT_THAT(error_of([&] { load_predictor(garbage); }), HasSubstr("is no TorchScript file"));
  const std::string whole = untrained("wedge");
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  EXPECT_THAT(error_of([&] { load_predictor(whole); }), HasSubstr("is no TorchScript file"));
  EXPECT_THAT(error_of([] { write_untrained_model("/nowhere/m.pt", "wedge", 1, false); }),
              HasSubstr("/nowhere/m.pt: cannot be written"));
  EXPECT_THAT(error_of([] { write_untrained_model("m.pt", "wegde", 1, false); }),
              HasSubstr("wedge or cmn"));
}

/// Files that Debian's python3-torch writes; the tests that need them are skipped where it is
/// absent.
class PythonModels : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder("python");
    const std::string command = "/usr/bin/python3 " CMN_SOURCE_DIR
                                "/test/support/python_models.py " +
                                folder_ + " > /dev/null";
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77) {
      GTEST_SKIP() << "torch for /usr/bin/python3 is absent (Debian: python3-torch)";
    }
    ASSERT_EQ(WEXITSTATUS(status), 0);
  }
  std::string error(const std::string& name) const {
    return error_of([&] { load_predictor(folder_ + "/" + name + ".pt"); });
  }
  std::string folder_;
};

TEST_F(PythonModels, ScriptedAndTracedOnesAreRun) {
  for (const char* name : {"/scripted.pt", "/traced.pt", "/scripted_half.pt"}) {
    SCOPED_TRACE(name);
    const auto predictor = load_predictor(folder_ + name);
    // They say how bright the front view's red is, everywhere to the left.
    ColorPanorama panorama;
    panorama.views[0].setTo(cv::Scalar{0, 0, 255});
    const PredictedOccupancy bright = predictor->predict(panorama);
    EXPECT_NEAR(bright.near.occupancy[bright.near.index_of(10, 100)], 1.0F, 1e-3F);
    EXPECT_NEAR(bright.near.occupancy[bright.near.index_of(10, 20)], 0.0F, 1e-3F);
    EXPECT_THAT(bright.near.confidence, ::testing::Each(1.0F));
    EXPECT_NEAR(predictor->predict(ColorPanorama{}).near.occupancy[bright.near.index_of(10, 100)],
                0.0F, 1e-3F);
  }
  EXPECT_TRUE(load_predictor(folder_ + "/pair.pt")->predict(ColorPanorama{}).wide.has_value());
}

TEST_F(PythonModels, OfAnotherSignatureAreRefusedByName) {
  EXPECT_THAT(error("two_inputs"), HasSubstr("takes 2 inputs"));
  EXPECT_THAT(error("small"), AllOf(HasSubstr("[1, 1, 64, 64]"), HasSubstr("128, 128")));
  EXPECT_THAT(error("logits"), HasSubstr("is the sigmoid missing?"));
  EXPECT_THAT(error("text"), HasSubstr("is no tensor"));
  EXPECT_THAT(error("triple"), HasSubstr("returns 3 values"));
  EXPECT_THAT(error("other_input"), HasSubstr("other_input.pt: "));
}

}  // namespace
}  // namespace cmn
