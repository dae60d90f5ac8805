// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/evaluation_plots.hpp"

#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/plot_panel.hpp"
#include "coarse_map_nav/evaluation/svg.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>

namespace cmn {
namespace {

using Rows = std::vector<EpisodeRow>;

/// Steps from 0 up at each of the sorted `moments`, `total` of them being everything.
std::vector<cv::Point2d> steps(const PlotPanel& panel, std::vector<int> moments,
                               std::size_t total) {
  std::sort(moments.begin(), moments.end());
  std::vector<cv::Point2d> points{panel.at(0.0, 0.0)};
  double share = 0.0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (i + 1 < moments.size() && moments[i + 1] == moments[i]) {
      continue;
    }
    const double x = std::min<double>(moments[i], panel.x_max);
    points.push_back(panel.at(x, share));
    share = static_cast<double>(i + 1) / static_cast<double>(total);
    points.push_back(panel.at(x, share));
  }
  points.push_back(panel.at(panel.x_max, share));
  return points;
}

template <class Condition>
std::vector<int> moments_of(const Rows& rows, int EpisodeRow::*moment, Condition&& counts) {
  std::vector<int> moments;
  for (const EpisodeRow& row : rows) {
    if (row.*moment >= 0 && counts(row)) {
      moments.push_back(row.*moment);
    }
  }
  return moments;
}

/// Later methods are drawn first, so that ours lies on top.
template <class Action>
void for_methods_backwards(const std::vector<std::string>& methods, Action&& action) {
  for (std::size_t i = methods.size(); i-- > 0;) {
    action(i, methods[i]);
  }
}

/// Whether this belief is worth a line: one that is always sure before the first action is told.
bool converges(const Rows& rows) {
  return std::any_of(rows.begin(), rows.end(),
                     [](const EpisodeRow& row) { return row.converged_actions > 0; });
}

void draw_footnote(Svg& svg, const std::string& text, double top) {
  svg.text(text, {kPlotLeft, top + 13.0}, 10.0, kPlotGrey);
}

constexpr double kCurveWidth = 260.0;
constexpr double kCurveHeight = 220.0;

}  // namespace

std::string success_plot(const std::vector<EpisodeTable>& tables, int horizon) {
  assert(!tables.empty());
  const std::vector<std::string> methods = methods_in(tables);
  constexpr double kWhisker = 9.0;  ///< width of one interval beside a panel
  const double beside = std::max(52.0, 8.0 + kWhisker * static_cast<double>(methods.size()));
  const double panel_width = kCurveWidth + beside + kPlotGap;
  const double width =
      kPlotLeft + panel_width * static_cast<double>(tables.size()) - kPlotGap + kPlotRight;
  const double legend_top = kPlotTop + kCurveHeight + 44.0;
  const double inner = width - kPlotLeft - kPlotRight;
  Svg svg{width, legend_top + legend_height(inner, methods) + 26.0};
  draw_plot_title(svg, "Success against actions", tables.front().task, width);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const double left = kPlotLeft + panel_width * static_cast<double>(t);
    const PlotPanel panel{{left, kPlotTop, kCurveWidth, kCurveHeight}, double(horizon), 1.0};
    const PlotPanel margin{{left, kPlotTop, kCurveWidth + beside, kCurveHeight}, 1.0, 1.0};
    margin.draw_percent_rules(svg, t == 0);
    panel.draw_count_axis(svg, "actions");
    svg.text("final", {left + kCurveWidth + beside / 2.0, kPlotTop + kCurveHeight + 15.0}, 10.0,
             kPlotGrey, Align::kMiddle);
    panel.draw_title(svg, tables[t]);
    if (t == 0) {
      panel.draw_value_name(svg, "episodes at the goal [%]");
    }
    for_methods_backwards(methods, [&](std::size_t i, const std::string& method) {
      const Rows rows = of_method(tables[t].rows, method);
      if (rows.empty()) {
        return;
      }
      const Stroke stroke = method_stroke(method, methods);
      svg.polyline(steps(panel,
                         moments_of(rows, &EpisodeRow::success_actions,
                                    [](const EpisodeRow& row) { return row.is_success; }),
                         rows.size()),
                   stroke);
      const Figure success = metrics_of(rows).success;
      const double x = panel.area.br().x + 8.0 + kWhisker * (static_cast<double>(i) + 0.5);
      draw_interval(svg, {x, panel.at(0.0, success.value).y}, {x, panel.at(0.0, success.low).y},
                    {x, panel.at(0.0, success.high).y}, stroke.colour);
    });
    panel.draw_axes(svg);
  }
  const double legend = draw_legend(svg, {kPlotLeft, legend_top}, inner, methods);
  draw_footnote(svg, "final: SR with its 95 % interval", legend_top + legend);
  return svg.finished();
}

std::string convergence_plot(const std::vector<EpisodeTable>& tables, int horizon) {
  assert(!tables.empty());
  const std::vector<std::string> known = methods_in(tables);
  std::vector<std::string> methods;
  std::copy_if(known.begin(), known.end(), std::back_inserter(methods), [&](const auto& method) {
    return std::any_of(tables.begin(), tables.end(), [&](const EpisodeTable& table) {
      return converges(of_method(table.rows, method));
    });
  });
  if (methods.empty()) {
    return "";
  }
  constexpr double kPanelWidth = kCurveWidth + kPlotGap;
  const double width =
      kPlotLeft + kPanelWidth * static_cast<double>(tables.size()) - kPlotGap + kPlotRight;
  const double legend_top = kPlotTop + kCurveHeight + 44.0;
  const double inner = width - kPlotLeft - kPlotRight;
  const double legend = legend_height(inner, methods);
  Svg svg{width, legend_top + legend + 26.0};
  draw_plot_title(svg, "First convergence of the belief", tables.front().task, width);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const double left = kPlotLeft + kPanelWidth * static_cast<double>(t);
    const PlotPanel panel{{left, kPlotTop, kCurveWidth, kCurveHeight}, double(horizon), 1.0};
    panel.draw_percent_rules(svg, t == 0);
    panel.draw_count_axis(svg, "actions");
    panel.draw_title(svg, tables[t]);
    if (t == 0) {
      panel.draw_value_name(svg, "episodes converged [%]");
    }
    for_methods_backwards(methods, [&](std::size_t /*i*/, const std::string& method) {
      const Rows rows = of_method(tables[t].rows, method);
      if (!converges(rows)) {
        return;
      }
      const Stroke stroke = method_stroke(method, known);
      const auto curve = [&](auto&& counts) {
        return steps(panel, moments_of(rows, &EpisodeRow::converged_actions, counts), rows.size());
      };
      svg.polyline(curve([](const EpisodeRow&) { return true; }), {stroke.colour, 1.1, "1.2 2.4"});
      svg.polyline(curve([](const EpisodeRow& row) { return !row.is_falsely_converged; }), stroke);
    });
    panel.draw_axes(svg);
  }
  draw_legend(svg, {kPlotLeft, legend_top}, inner, methods);
  draw_footnote(svg, "drawn through: to the right place; dotted: to any", legend_top + legend);
  return svg.finished();
}

}  // namespace cmn
