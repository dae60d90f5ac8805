// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/plot_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>

namespace cmn {
namespace {

constexpr double kSmall = 10.0;  ///< font size of numbers
constexpr double kLegendRow = 18.0;
constexpr double kLegendEntry = 94.0;
const Stroke kRule{"#e3e6ea", 1.0, ""};
const Stroke kAxis{"#4a525c", 1.0, ""};

std::size_t entries_a_row(double width) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(width / kLegendEntry));
}

/// A distance between ticks that people like, for about five of them.
double tick_distance(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  const double share = range / 5.0 / power;
  return std::max(1.0, power * (share <= 1.0   ? 1.0
                                : share <= 2.0 ? 2.0
                                : share <= 5.0 ? 5.0
                                               : 10.0));
}

std::string whole(double value) { return std::to_string(std::lround(value)); }

}  // namespace

std::vector<std::string> methods_in(const std::vector<EpisodeTable>& tables) {
  std::vector<EpisodeRow> rows;
  for (const EpisodeTable& table : tables) {
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  }
  return methods_of(rows);
}

void draw_plot_title(Svg& svg, const std::string& what, const std::string& task, double width) {
  svg.text(what, {kPlotLeft, 20.0}, 13.0, kPlotInk, Align::kLeft, true);
  const std::string title = task_title(task);
  const double room = width - kPlotLeft - kPlotRight;
  const double size = std::min(kPlotFont, kPlotFont * room / Svg::text_width(title, kPlotFont));
  svg.text(title, {kPlotLeft, 36.0}, size, kPlotGrey);
}

Stroke method_stroke(const std::string& method, const std::vector<std::string>& methods) {
  static const std::map<std::string, Stroke> kKnown{{"ours", {"#0072b2", 2.6, ""}},
                                                    {"cmn", {"#d55e00", 1.7, ""}},
                                                    {"robb", {"#009e73", 1.7, ""}},
                                                    {"mcse", {"#cc79a7", 1.7, ""}},
                                                    {"rmn", {"#e69f00", 1.7, ""}},
                                                    {"rnd", {"#8a8a8a", 1.7, ""}},
                                                    {"true_pose", {"#56b4e9", 1.7, "6 2.5"}},
                                                    {"oracle", {"#000000", 1.4, "6 2.5"}}};
  static const std::array<std::string, 4> kOthers{"#5d3a1a", "#882255", "#117733", "#4b4b9b"};
  const auto known = kKnown.find(method);
  if (known != kKnown.end()) {
    return known->second;
  }
  std::size_t place = 0;
  for (const std::string& other : methods) {
    if (other == method) {
      break;
    }
    place += kKnown.count(other) == 0 ? 1 : 0;
  }
  return {kOthers[place % kOthers.size()], 1.7, "8 2 2 2"};
}

void PlotPanel::draw_percent_rules(Svg& svg, bool with_numbers) const {
  for (int percent = 0; percent <= 100; percent += 20) {
    const cv::Point2d left = at(0.0, percent / 100.0);
    svg.line(left, {area.br().x, left.y}, kRule);
    if (with_numbers) {
      svg.text(std::to_string(percent), {left.x - 7.0, left.y + 3.5}, kSmall, kPlotGrey,
               Align::kRight);
    }
  }
}

void PlotPanel::draw_count_axis(Svg& svg, const std::string& name) const {
  const double step = tick_distance(x_max);
  for (double x = 0.0; x <= x_max * 1.0001; x += step) {
    const cv::Point2d foot = at(x, 0.0);
    svg.line(foot, {foot.x, foot.y + 4.0}, kAxis);
    svg.text(whole(x), {foot.x, foot.y + 15.0}, kSmall, kPlotGrey, Align::kMiddle);
  }
  svg.text(name, {area.x + area.width / 2.0, area.br().y + 31.0}, kPlotFont, kPlotGrey,
           Align::kMiddle);
}

void PlotPanel::draw_value_name(Svg& svg, const std::string& name) const {
  svg.text(name, {area.x - 38.0, area.y + area.height / 2.0}, kPlotFont, kPlotGrey, Align::kMiddle,
           false, -90.0);
}

void PlotPanel::draw_title(Svg& svg, const EpisodeTable& table) const {
  std::size_t most = 0;  // episodes of a method; one that ran fewer is named in the report
  for (const std::string& method : methods_of(table.rows)) {
    most = std::max(most, of_method(table.rows, method).size());
  }
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.2f m/cell, %zu episodes", table.mpp, most);
  svg.text(text.data(), {area.x, area.y - 14.0}, kPlotFont, kPlotInk);
}

void PlotPanel::draw_axes(Svg& svg) const {
  svg.polyline({area.tl(), {area.x, area.br().y}, area.br()}, kAxis);
}

void draw_interval(Svg& svg, cv::Point2d value, cv::Point2d low, cv::Point2d high,
                   const std::string& colour) {
  svg.line(low, high, {colour, 1.3, ""});
  svg.disc(value, 2.6, colour);
}

double legend_height(double width, const std::vector<std::string>& methods) {
  const std::size_t a_row = entries_a_row(width);
  return kLegendRow * static_cast<double>((methods.size() + a_row - 1) / a_row);
}

double draw_legend(Svg& svg, cv::Point2d corner, double width,
                   const std::vector<std::string>& methods) {
  const std::size_t a_row = entries_a_row(width);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const cv::Point2d at{corner.x + kLegendEntry * static_cast<double>(i % a_row),
                         corner.y + kLegendRow * (0.5 + static_cast<double>(i / a_row))};
    svg.line(at, {at.x + 24.0, at.y}, method_stroke(methods[i], methods));
    svg.text(method_label(methods[i]), {at.x + 30.0, at.y + 4.0}, kPlotFont);
  }
  return legend_height(width, methods);
}

}  // namespace cmn
