// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/params.hpp"

#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(Params, EveryPresetLoadsWithoutAProblem) {
  int presets = 0;
  for (const auto& entry : std::filesystem::directory_iterator{CMN_SOURCE_DIR "/config"}) {
    if (entry.path().extension() == ".yaml") {
      NavigatorParams params;
      EXPECT_THAT(load_params(read_param_file(entry.path().string()), params), testing::IsEmpty())
          << entry.path();
      ++presets;
    }
  }
  EXPECT_GE(presets, 3);
}

TEST(Params, EachHasAPathOfItsOwnARangeAndAMeaning) {
  std::set<std::string> paths;
  for (const ParamDoc& doc : list_params(NavigatorParams{})) {
    EXPECT_TRUE(paths.insert(doc.path).second) << doc.path;
    EXPECT_FALSE(doc.range.empty() || doc.text.empty() || doc.default_value.empty()) << doc.path;
  }
}

TEST(Params, DefaultsAreWithinTheirRanges) {
  ParamTree tree;
  for (const ParamDoc& doc : list_params(NavigatorParams{})) {
    const bool is_truth = doc.default_value == "true" || doc.default_value == "false";
    const bool is_word = doc.default_value.find_first_not_of("0123456789.+-e") != std::string::npos;
    tree[doc.path] = is_truth  ? ParamValue{doc.default_value == "true"}
                     : is_word ? ParamValue{doc.default_value}
                               : ParamValue{std::stod(doc.default_value)};
  }
  NavigatorParams params;
  EXPECT_THAT(load_params(tree, params), testing::IsEmpty());
}

TEST(Params, NumbersAreListedWithAllTheirDigits) {
  LocalizationParams params;
  params.seed = 4294967295U;
  params.independence_m = 0.1 + 0.2;
  for (const ParamDoc& doc : list_params(params)) {
    if (doc.path == "seed") {
      EXPECT_EQ(doc.default_value, "4294967295");
      EXPECT_EQ(doc.range, "[0, 4294967295]");
    }
    if (doc.path == "independence_m") {
      EXPECT_EQ(doc.default_value, "0.30000000000000004");
    }
    if (doc.path == "contradiction_evidence") {
      EXPECT_EQ(doc.default_value, "1e-06");
    }
  }
}

TEST(Params, ANumberThatMustBeAMultipleIsOne) {
  NavigatorParams params;
  const std::string path = "localization/scaled/headings";
  EXPECT_THAT(load_params({{path, 36.0}}, params), testing::IsEmpty());
  EXPECT_EQ(params.localization.scaled.headings, 36);
  EXPECT_THAT(load_params({{path, 6.0}}, params),
              testing::ElementsAre(path + ": 6 is none of the multiples of 4 up to 360"));
  EXPECT_THAT(load_params({{path, 0.0}}, params),
              testing::ElementsAre(path + ": 0 is outside [4, 360]"));
  EXPECT_THAT(load_params({{path, 8.5}}, params),
              testing::ElementsAre(path + ": 8.5 is not a whole number"));
  EXPECT_EQ(params.localization.scaled.headings, 36);
}

}  // namespace
}  // namespace cmn
