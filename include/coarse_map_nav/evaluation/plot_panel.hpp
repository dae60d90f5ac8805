// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Axes, legends and the look of the methods, shared by the plots of an evaluation.
#pragma once

#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/svg.hpp"

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

// The margins that the plots have in common, their colours, and the size of most of their text.
constexpr double kPlotLeft = 54.0;  ///< room for the numbers of the first panel
constexpr double kPlotRight = 14.0;
constexpr double kPlotTop = 68.0;  ///< room for the titles
constexpr double kPlotGap = 26.0;  ///< between panels
constexpr double kPlotFont = 11.0;
constexpr const char* kPlotInk = "#262c34";
constexpr const char* kPlotGrey = "#5c646e";

/// The methods of all panels.
std::vector<std::string> methods_in(const std::vector<EpisodeTable>& tables);

/// What the plot shows, and of which task.
void draw_plot_title(Svg& svg, const std::string& what, const std::string& task, double width);

/// The look of a method in every plot: the palette of Okabe and Ito (2008), which the colour-blind
/// can tell apart, dashes for the bounds. A method that is not known takes the look that its place
/// in `methods` gives it.
Stroke method_stroke(const std::string& method, const std::vector<std::string>& methods);

/// A rectangle of a plot in which values from 0 up are drawn.
struct PlotPanel {
  cv::Rect2d area;
  double x_max = 1.0;
  double y_max = 1.0;

  cv::Point2d at(double x, double y) const {
    return {area.x + x / x_max * area.width, area.br().y - y / y_max * area.height};
  }
  /// Rules at 0, 20 .. 100 % across, with their numbers when asked for.
  void draw_percent_rules(Svg& svg, bool with_numbers) const;
  /// Ticks and numbers under the panel at round distances, and what they count.
  void draw_count_axis(Svg& svg, const std::string& name) const;
  /// What the numbers to the left count.
  void draw_value_name(Svg& svg, const std::string& name) const;
  /// "0.40 m/cell, 50 episodes" above the panel.
  void draw_title(Svg& svg, const EpisodeTable& table) const;
  /// The two axes themselves.
  void draw_axes(Svg& svg) const;
};

/// A value with whiskers to the ends of its interval, upright or lying.
void draw_interval(Svg& svg, cv::Point2d value, cv::Point2d low, cv::Point2d high,
                   const std::string& colour);

/// Line samples with the methods' names, as many in a row as fit. Returns the height taken.
double draw_legend(Svg& svg, cv::Point2d corner, double width,
                   const std::vector<std::string>& methods);
/// How tall that legend will be.
double legend_height(double width, const std::vector<std::string>& methods);

}  // namespace cmn
