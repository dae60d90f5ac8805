// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/node_params.hpp"

#include "coarse_map_nav/ros/node.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using testing::IsEmpty;

template <class Own>
std::vector<std::string> problems_of(const ParamTree& tree) {
  NodeParams<Own> params;
  return load_params(tree, params);
}

/// Every shipped file of parameters, presets and robots.
std::vector<std::string> shipped_configs() {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(CMN_SOURCE_DIR "/config")) {
    // Variants are what cmn_evaluate changes of presets.
    if (entry.path().extension() == ".yaml" &&
        entry.path().parent_path().filename() != "variants") {
      files.push_back(entry.path().string());
    }
  }
  return files;
}

TEST(ShippedConfig, LoadsInEveryNodeWithoutAProblem) {
  const std::vector<std::string> files = shipped_configs();
  ASSERT_GE(files.size(), 3U);
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const ParamTree tree = read_param_file(file);
    EXPECT_FALSE(tree.empty());
    EXPECT_THAT(problems_of<SimulatorNodeParams>(tree), IsEmpty());
    if (file.find("/robots/simulated/") != std::string::npos) {
      continue;  // the simulator's alone
    }
    EXPECT_THAT(problems_of<MapServerParams>(tree), IsEmpty());
    EXPECT_THAT(problems_of<PerceptionNodeParams>(tree), IsEmpty());
    EXPECT_THAT(problems_of<LocalizerNodeParams>(tree), IsEmpty());
    EXPECT_THAT(problems_of<PlannerNodeParams>(tree), IsEmpty());
    EXPECT_THAT(problems_of<MotionNodeParams>(tree), IsEmpty());
  }
}

TEST(NodeParams, AreWhatTheyAreCalledAndSayEveryProblemAtOnce) {
  const ParamTree tree{{"transform_tolerance_s", 99.0},
                       {"update_on", std::string{"sometimes"}},
                       {"frames/bas", std::string{"base"}},
                       {"localization/motion/type", 3.0}};
  EXPECT_THAT(problems_of<LocalizerNodeParams>(tree),
              testing::UnorderedElementsAre(testing::HasSubstr("transform_tolerance_s: 99"),
                                            testing::HasSubstr("update_on: \"sometimes\""),
                                            testing::HasSubstr("did you mean frames/base?"),
                                            testing::HasSubstr("localization/motion/type")));
}

}  // namespace
}  // namespace cmn
