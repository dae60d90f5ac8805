// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/svg.hpp"

#include "coarse_map_nav/evaluation/plot_panel.hpp"

#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

TEST(Svg, ShapesBecomeElements) {
  Svg svg{100.0, 50.5};
  svg.polyline({{1.0, 2.0}, {3.005, 4.5}}, {"#123456", 2.0, "4 2"});
  svg.fill({1.0, 2.0, 3.0, 4.0}, "#ffffff", 0.5);
  svg.disc({5.0, 6.0}, 0.25, "red");
  svg.text("90", {7.0, 8.0}, 9.0, "black", Align::kRight, true, -90.0);
  const std::string file = svg.finished();
  for (const char* part :
       {"viewBox=\"0 0 100 50.5\"", "points=\"1,2 3,4.5\"", "stroke-dasharray=\"4 2\"",
        "width=\"3\" height=\"4\" fill=\"#ffffff\" fill-opacity=\"0.5\"",
        "<circle cx=\"5\" cy=\"6\" r=\"0.25\" fill=\"red\"/>", "text-anchor=\"end\"",
        "transform=\"rotate(-90 7 8)\""}) {
    EXPECT_THAT(file, HasSubstr(part));
  }
}

TEST(Svg, TextCannotBreakTheFile) {
  Svg svg{10.0, 10.0};
  svg.text("a < b & c > d", {0.0, 0.0}, 9.0);
  EXPECT_THAT(svg.finished(), HasSubstr(">a &lt; b &amp; c &gt; d</text>"));
}

TEST(MethodStroke, TellsMethodsApart) {
  const std::vector<std::string> methods{"ours", "cmn",       "robb",   "mcse", "rmn",
                                         "rnd",  "true_pose", "oracle", "amcl", "later"};
  std::set<std::string> colours;
  for (const std::string& method : methods) {
    colours.insert(method_stroke(method, methods).colour);
  }
  EXPECT_EQ(colours.size(), methods.size());
  EXPECT_EQ(method_stroke("cmn", {"cmn"}).colour, method_stroke("cmn", methods).colour);
}

}  // namespace
}  // namespace cmn
