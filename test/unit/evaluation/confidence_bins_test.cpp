// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/confidence_bins.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(ConfidenceBins, HoldEachLookInTheBinOfItsConfidence) {
  for (std::size_t i = 0; i < ConfidenceBins::kCount; ++i) {
    const double low = ConfidenceBins::kEdges[i];
    const double high = ConfidenceBins::kEdges[i + 1];
    ConfidenceBins bins;
    bins.add(low, true);
    bins.add(0.5 * (low + high), false);
    EXPECT_EQ(bins.bins()[i].looks, 2) << i;
    EXPECT_EQ(bins.bins()[i].right, 1) << i;
    EXPECT_DOUBLE_EQ(bins.bins()[i].stated, 1.5 * low + 0.5 * high);
  }
  ConfidenceBins sure;
  sure.add(1.0, true);
  sure.add(1.0 + 1e-9, true);  // a sum of floats
  EXPECT_EQ(sure.bins().back().looks, 2);
}

TEST(ConfidenceBins, SurviveTheirText) {
  ConfidenceBins bins;
  EXPECT_EQ(bins.text(), "-");
  EXPECT_EQ(ConfidenceBins::parse("-").looks(), 0);
  bins.add(0.04, false);
  bins.add(0.05, true);
  bins.add(0.9995, true);
  EXPECT_EQ(bins.text(), "0:2:1:0.090 12:1:1:1.000");
  EXPECT_EQ(ConfidenceBins::parse(bins.text()).text(), bins.text());
  ConfidenceBins twice = bins;
  twice.add(bins);
  EXPECT_EQ(twice.text(), "0:4:2:0.180 12:2:2:1.999");
}

TEST(ConfidenceBins, OfNonsenseAreRefused) {
  for (const char* text : {"x", "0:1:1", "13:1:1:1.0", "0:1:2:0.1", "0:0:0:0.0", "0:1:1:0.1x"}) {
    EXPECT_THROW(ConfidenceBins::parse(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace cmn
