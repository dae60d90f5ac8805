// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/evaluation_plots.hpp"
#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/plot_panel.hpp"
#include "coarse_map_nav/evaluation/svg.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace cmn {
namespace {

/// A bar with its interval, and its height in per cent above both.
void draw_bar(Svg& svg, const PlotPanel& panel, double left, double width, const Figure& figure,
              const std::string& colour) {
  const double top = panel.at(0.0, figure.value).y;
  const double middle = left + width / 2.0;
  svg.fill({left, top, width, panel.area.br().y - top}, colour, 0.85);
  const double high = panel.at(0.0, figure.high).y;
  const Stroke whisker{kPlotInk, 1.1, ""};
  // A pale edge, for the part that lies on a dark bar.
  svg.line({middle, panel.at(0.0, figure.low).y}, {middle, high}, {"#ffffff", 3.1, ""});
  svg.line({middle, panel.at(0.0, figure.low).y}, {middle, high}, whisker);
  for (const double end : {figure.low, figure.high}) {
    const double y = panel.at(0.0, end).y;
    svg.line({middle - 2.5, y}, {middle + 2.5, y}, whisker);
  }
  svg.text(std::to_string(std::lround(100.0 * figure.value)), {middle, high - 4.0}, 9.5, kPlotInk,
           Align::kMiddle);
}

}  // namespace

std::string bar_plot(const std::vector<EpisodeTable>& tables) {
  assert(!tables.empty());
  const std::vector<std::string> methods = methods_in(tables);
  constexpr double kBar = 18.0;
  constexpr double kPitch = 24.0;  ///< from bar to bar
  constexpr double kHeight = 150.0;
  constexpr double kNames = 66.0;  ///< room for the slanting names of the methods
  constexpr double kBetween = 26.0;
  const double inner = kPitch * static_cast<double>(methods.size()) + 8.0;
  const double panel_width = std::max(inner, 170.0);
  const auto count = static_cast<double>(tables.size());
  const double width =
      kPlotLeft + count * panel_width + (count - 1.0) * kPlotGap + 2.0 * kPlotRight;
  Svg svg{width, kPlotTop + 2.0 * kHeight + kBetween + kNames};
  draw_plot_title(svg, "Success (SR) and SPL", tables.front().task, width);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const double left = kPlotLeft + static_cast<double>(t) * (panel_width + kPlotGap);
    const PlotPanel sr{{left, kPlotTop, panel_width, kHeight}};
    const PlotPanel spl{{left, kPlotTop + kHeight + kBetween, panel_width, kHeight}};
    for (const PlotPanel* panel : {&sr, &spl}) {
      panel->draw_percent_rules(svg, t == 0);
    }
    if (t == 0) {
      sr.draw_value_name(svg, "SR [%]");
      spl.draw_value_name(svg, "SPL [%]");
    }
    sr.draw_title(svg, tables[t]);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const std::string& method = methods[i];
      const std::string colour = method_stroke(method, methods).colour;
      const double bar_left = left + 4.0 + kPitch * static_cast<double>(i) + (kPitch - kBar) / 2.0;
      const double middle = bar_left + kBar / 2.0;
      svg.text(method_label(method), {middle + 4.0, spl.area.br().y + 13.0}, 10.5, kPlotInk,
               Align::kRight, false, -45.0);
      const Metrics metrics = metrics_of(of_method(tables[t].rows, method));
      if (metrics.episodes > 0) {
        draw_bar(svg, sr, bar_left, kBar, metrics.success, colour);
        draw_bar(svg, spl, bar_left, kBar, metrics.spl, colour);
      }
    }
    sr.draw_axes(svg);
    spl.draw_axes(svg);
  }
  return svg.finished();
}

std::string building_plot(const std::vector<EpisodeTable>& tables) {
  assert(!tables.empty());
  const std::vector<std::string> methods = methods_in(tables);
  std::vector<EpisodeRow> rows;
  for (const EpisodeTable& table : tables) {
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  }
  std::vector<std::string> buildings = buildings_of(rows);
  constexpr const char* kAll = "all";
  if (buildings.size() > 1) {
    buildings.emplace_back(kAll);
  }
  double names = 40.0;
  for (const std::string& building : buildings) {
    names = std::max(names, Svg::text_width(building, kPlotFont) + 14.0);
  }
  constexpr double kWidth = 230.0;
  constexpr double kLine = 8.0;  ///< from interval to interval
  const double band = kLine * static_cast<double>(methods.size()) + 8.0;
  const double height = band * static_cast<double>(buildings.size());
  const auto count = static_cast<double>(tables.size());
  const double width = names + count * (kWidth + kPlotGap) + kPlotRight;
  const double legend_top = kPlotTop + height + 44.0;
  const double inner = width - names - kPlotRight;
  Svg svg{width, legend_top + legend_height(inner, methods) + 10.0};
  draw_plot_title(svg, "SPL by building", tables.front().task, width);
  for (std::size_t b = 0; b < buildings.size(); ++b) {
    const double top = kPlotTop + band * static_cast<double>(b);
    if (b % 2 == 0) {
      svg.fill({0.0, top, width, band}, "#f4f5f7");
    }
    svg.text(buildings[b], {names - 8.0, top + band / 2.0 + 4.0}, kPlotFont, kPlotInk,
             Align::kRight, buildings[b] == kAll);
  }
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const double left = names + static_cast<double>(t) * (kWidth + kPlotGap);
    const PlotPanel panel{{left, kPlotTop, kWidth, height}, 100.0, 1.0};
    panel.draw_title(svg, tables[t]);
    panel.draw_count_axis(svg, "SPL [%]");
    for (std::size_t b = 0; b < buildings.size(); ++b) {
      const std::vector<EpisodeRow> here =
          buildings[b] == kAll ? tables[t].rows : of_building(tables[t].rows, buildings[b]);
      for (std::size_t i = 0; i < methods.size(); ++i) {
        const Figure spl = metrics_of(of_method(here, methods[i])).spl;
        const double y =
            kPlotTop + band * static_cast<double>(b) + 4.0 + kLine * (static_cast<double>(i) + 0.5);
        if (!std::isnan(spl.value)) {
          draw_interval(
              svg, {panel.at(100.0 * spl.value, 0.0).x, y}, {panel.at(100.0 * spl.low, 0.0).x, y},
              {panel.at(100.0 * spl.high, 0.0).x, y}, method_stroke(methods[i], methods).colour);
        }
      }
    }
    panel.draw_axes(svg);
  }
  draw_legend(svg, {names, legend_top}, inner, methods);
  return svg.finished();
}

}  // namespace cmn
