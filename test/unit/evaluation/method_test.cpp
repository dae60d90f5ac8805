// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/method.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include "file_fixture.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

const std::string kConfig = CMN_SOURCE_DIR "/config";

std::string refusal_of_task(const std::string& name) {
  try {
    find_task(name);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

std::string refusal_of_method(const std::string& name) {
  try {
    find_method(name);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

double free_share(const CoarseMap& map) {
  return static_cast<double>(map.free_count()) / static_cast<double>(map.occupied().size());
}

TEST(Task, AnUnknownOneIsRefusedWithAListOfAll) {
  EXPECT_EQ(refusal_of_task("XX"),
            "task \"XX\" is none of CG, CI, HD, CL, CD, CF, HL, WL, TL, CLK, CFK, HLK, WLK");
  for (const char* name : {"CG", "CI", "HD", "CL", "CD", "CF", "HL", "WL"}) {
    EXPECT_EQ(find_task(name).name, name);
  }
}

TEST(Task, OnlyThePapersOwnKnowsTheHeading) {
  for (const char* name : {"CG", "CI", "HD", "CL", "CD", "CF", "HL", "WL"}) {
    EXPECT_EQ(find_task(name).knows_heading, find_task(name).has_paper_setting);
    const std::set<std::string> papers_own{"CG", "CI", "HD"};
    EXPECT_EQ(find_task(name).knows_heading, papers_own.count(name) == 1);
  }
}

TEST(Task, OfEveryRobotThatKeepsTheSameRulesThereIsOneThatIsKidnapped) {
  for (const std::string name : {"CL", "CF", "HL", "WL"}) {
    const Task& task = find_task(name);
    const Task& kidnapped = find_task(name + "K");
    EXPECT_FALSE(task.kidnaps);
    EXPECT_TRUE(kidnapped.kidnaps);
    EXPECT_EQ(task.drawing, kidnapped.drawing);
    EXPECT_EQ(task.observation, kidnapped.observation);
  }
}

TEST(Task, DrawsItsMap) {
  // A room of 8 m x 8 m with a post of 1 m2 in it, in cells of 0.05 m.
  Grid<std::uint8_t> occupied{160, 160};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Cell c = occupied.cell_at(i);
    const bool is_wall = c.x < 4 || c.y < 4 || c.x >= 156 || c.y >= 156;
    const bool is_post = c.x >= 60 && c.x < 80 && c.y >= 60 && c.y < 80;
    occupied[i] = is_wall || is_post;
  }
  const CoarseMap world{occupied, 0.05};
  const CoarseMap plain = draw(find_task("CL"), world, nullptr, 0.4, 1, 0.2).map();
  EXPECT_EQ(plain.width(), 20);
  EXPECT_TRUE(plain.is_occupied({8, 8}));
  // Where the middle of a robot of 0.2 m can be: half a cell less at each wall.
  const CoarseMap navigable = draw(find_task("CG"), world, nullptr, 0.4, 1, 0.2).map();
  EXPECT_LT(free_share(navigable), free_share(plain));
  EXPECT_TRUE(navigable.is_free({4, 4}));
  EXPECT_EQ(draw(find_task("CI"), world, nullptr, 0.4, 1, 0.2).map().occupied(),
            navigable.occupied());
  const CoarseMap walls = draw(find_task("WL"), world, nullptr, 0.4, 1, 0.2).map();
  EXPECT_TRUE(walls.is_free({8, 8}));
  // The walls of a house are known.
  const CoarseMap all_free{Grid<std::uint8_t>{160, 160}, 0.05};
  EXPECT_EQ(free_share(draw(find_task("WL"), world, &all_free, 0.4, 1, 0.2).map()), 1.0);
  const CoarseMap turned = draw(find_task("TL"), world, nullptr, 0.4, 1, 0.2).map();
  EXPECT_NEAR(turned.T_map_grid().yaw - world.T_map_grid().yaw, kDrawingTurn_rad, 1e-12);
  EXPECT_TRUE(turned.is_free(turned.cell_of({1.0, 1.0})));
  const Drawing drawn = draw(find_task("HL"), world, nullptr, 0.4, 1, 0.2);
  EXPECT_GT(drawn.map().free_count(), 0U);
  EXPECT_FALSE(drawn.map().occupied() ==
               draw(find_task("HL"), world, nullptr, 0.4, 2, 0.2).map().occupied());
}

TEST(Method, AnUnknownOneIsRefusedWithAListOfAll) {
  const std::string refusal = refusal_of_method("magic");
  EXPECT_EQ(refusal.find("method \"magic\" is none of "), 0U);
  for (const std::string& name : method_names()) {
    EXPECT_NE(refusal.find(name), std::string::npos);
    EXPECT_EQ(find_method(name).name, name);
  }
}

TEST(Method, AllOfThePapersAreThere) {
  const std::vector<std::string> names = method_names();
  for (const char* name : {"ours", "cmn", "robb", "mcse", "rmn", "rnd", "true_pose", "oracle"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
}

TEST(Method, EachHasItsPresetForEachTask) {
  for (const std::string& name : method_names()) {
    for (const char* task : {"CG", "CI", "HD", "CL", "CD", "CF", "HL", "WL"}) {
      EXPECT_NO_THROW(method_params(find_method(name), find_task(task), kConfig)) << name;
    }
  }
}

TEST(Method, OursInAPanoramaIsThePresetOfThatSensor) {
  for (const auto& [task, preset] : {std::pair{"CD", "depth"}, std::pair{"CI", "rgb"}}) {
    NavigatorParams params;
    ASSERT_TRUE(load_params(read_param_file(kConfig + "/" + preset + ".yaml"), params).empty());
    if (find_task(task).has_paper_setting) {
      params.perception.guard.type = "none";
    }
    const std::vector<ParamDoc> a = list_params(params);
    const std::vector<ParamDoc> b =
        list_params(method_params(find_method("ours"), find_task(task), kConfig));
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].default_value, b[i].default_value) << a[i].path;
    }
  }
}

TEST(Method, CmnIsThatOfTheReleasedParameters) {
  const NavigatorParams params = method_params(find_method("cmn"), find_task("CG"), kConfig);
  EXPECT_TRUE(find_method("cmn").knows_heading);
  EXPECT_EQ(params.localization.filter, "discrete");
  EXPECT_EQ(params.localization.motion.type, "noisy");
  EXPECT_EQ(params.localization.measurement.window_cells(), 3);
  EXPECT_EQ(params.localization.measurement.exponent, 2.0);
  EXPECT_EQ(params.planning.policy, "heuristic_tree");
  EXPECT_EQ(params.planning.tree_depth, 2);
  EXPECT_EQ(params.planning.step_m, 0.15);
  EXPECT_EQ(params.planning.max_actions, 500);
  EXPECT_EQ(params.perception.guard.type, "none");
}

TEST(Method, AllBaselinesHaveCmnsPlannerWhereThePaperHasIt) {
  for (const char* name : {"cmn", "mcse", "rmn"}) {
    EXPECT_EQ(method_params(find_method(name), find_task("CG"), kConfig).planning.policy,
              "heuristic_tree")
        << name;
    const NavigatorParams params = method_params(find_method(name), find_task("CL"), kConfig);
    EXPECT_EQ(params.planning.policy, "lattice") << name;
    EXPECT_NE(params.perception.guard.type, "none") << name;
  }
}

TEST(Method, AFaultyPresetIsNamedWithAllItsFaults) {
  const std::string file = file_with("faulty.yaml", "planning: {policy: magic, tree_depth: 99}\n");
  const std::size_t slash = file.rfind('/');
  Method method{"mine", file.substr(slash + 1)};
  const std::string error =
      error_of([&] { method_params(method, find_task("CL"), file.substr(0, slash)); });
  EXPECT_NE(error.find("faulty.yaml"), std::string::npos);
  EXPECT_NE(error.find("magic"), std::string::npos);
  EXPECT_NE(error.find("tree_depth"), std::string::npos);
}

}  // namespace
}  // namespace cmn
