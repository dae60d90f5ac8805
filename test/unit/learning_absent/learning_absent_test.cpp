// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/torch_predictor.hpp"
#include "coarse_map_nav/learning/training.hpp"

#include "file_fixture.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

TEST(LearningAbsent, WhoeverAsksIsToldWhatToInstall) {
  EXPECT_THAT(error_of([] { load_predictor("model.pt"); }), HasSubstr("libtorch-dev"));
  EXPECT_THAT(error_of([] { train(TrainingJob{}); }), HasSubstr("libtorch-dev"));
  EXPECT_THAT(error_of([] { ExampleFile{"house.h5"}; }), HasSubstr("libhdf5-dev"));
}

}  // namespace
}  // namespace cmn
