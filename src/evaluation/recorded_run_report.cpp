// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/plot_panel.hpp"
#include "coarse_map_nav/evaluation/recorded_run.hpp"
#include "coarse_map_nav/evaluation/svg.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

namespace cmn {
namespace {

constexpr double kLeast_m = 0.1;  ///< of the plots' logarithmic axis
constexpr double kDecades = 3.0;
constexpr const char* kAll = "all";

/// In order of appearance.
std::vector<std::string> names_of(const std::vector<RecordedRun>& runs,
                                  std::string RecordedRun::*name) {
  std::vector<std::string> names;
  for (const RecordedRun& run : runs) {
    if (std::find(names.begin(), names.end(), run.*name) == names.end()) {
      names.push_back(run.*name);
    }
  }
  return names;
}

/// `building` may be kAll.
std::vector<const RecordedRun*> select(const std::vector<RecordedRun>& runs,
                                       const std::string& building, const std::string& method) {
  std::vector<const RecordedRun*> selected;
  for (const RecordedRun& run : runs) {
    if ((building == kAll || run.building == building) && run.method == method) {
      selected.push_back(&run);
    }
  }
  return selected;
}

Figure found_share(const std::vector<const RecordedRun*>& runs, const RecordedRunParams& params) {
  int found = 0;
  for (const RecordedRun* run : runs) {
    found += run->is_right_from(params.find_m, params.within_m);
  }
  return wilson_share(found, static_cast<int>(runs.size()));
}

/// Of the last look up to there; of the first where there is none.
double error_at(const RecordedRun& run, double driven_m) {
  double error_m = run.looks.front().error_m;
  for (const RecordedLook& look : run.looks) {
    if (look.driven_m > driven_m) {
      break;
    }
    error_m = look.error_m;
  }
  return error_m;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - std::floor(place)) * (values[high] - values[low]);
}

std::string text_of(const Figure& figure) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.2f [%.2f, %.2f]", figure.value, figure.low,
                figure.high);
  return text.data();
}

Stroke stroke_of(std::size_t method) {
  static const std::array<Stroke, 4> kStrokes{
      {{"#0072b2", 2.2, ""}, {"#d55e00", 2.2, ""}, {"#009e73", 2.2, ""}, {"#cc79a7", 2.2, ""}}};
  return kStrokes[method % kStrokes.size()];
}

/// Of a panel whose y axis is the logarithm of an error, 0 to 1.
cv::Point2d place_of(const PlotPanel& panel, double driven_m, double error_m) {
  const double decades = std::log10(std::max(error_m, kLeast_m) / kLeast_m);
  return panel.at(driven_m, std::min(1.0, decades / kDecades));
}

void draw_curves(Svg& svg, const PlotPanel& panel, const std::vector<const RecordedRun*>& runs,
                 const Stroke& stroke) {
  for (const double share : {0.25, 0.5, 0.75}) {
    std::vector<cv::Point2d> points;
    for (double driven_m = 0.0; driven_m <= panel.x_max + 1e-9; driven_m += 0.5) {
      std::vector<double> errors;
      for (const RecordedRun* run : runs) {
        errors.push_back(error_at(*run, driven_m));
      }
      points.push_back(place_of(panel, driven_m, quantile(std::move(errors), share)));
    }
    svg.polyline(points, share == 0.5 ? stroke : Stroke{stroke.colour, 0.8, "3 2"});
  }
}

void draw_rules(Svg& svg, const PlotPanel& panel, const RecordedRunParams& params,
                bool with_numbers) {
  for (const auto& [error_m, text] :
       {std::pair{0.1, "0.1"}, {1.0, "1"}, {10.0, "10"}, {100.0, "100"}}) {
    const cv::Point2d left = place_of(panel, 0.0, error_m);
    svg.line(left, {panel.area.br().x, left.y}, {"#e3e6ea", 1.0, ""});
    if (with_numbers) {
      svg.text(text, {left.x - 7.0, left.y + 3.5}, 10.0, kPlotGrey, Align::kRight);
    }
  }
  const Stroke target{kPlotGrey, 0.9, "1.5 2.5"};
  const cv::Point2d bound = place_of(panel, params.find_m, params.within_m);
  svg.line(bound, {panel.area.br().x, bound.y}, target);
  svg.line(bound, {bound.x, panel.area.y}, target);
}

}  // namespace

std::string csv_of(const std::vector<RecordedRun>& runs, const RecordedRunParams& params) {
  std::ostringstream text;
  text << "building,method,index,start_s,start_x_m,start_y_m,driven_m,looks,success,found_m,"
          "error_m,worst_error_m,yaw_error_deg,scale,confidence,converged\n"
       << std::fixed << std::setprecision(3);
  for (const RecordedRun& run : runs) {
    const RecordedLook& first = run.looks.front();
    const RecordedLook& last = run.looks.back();
    double worst_m = 0.0;
    for (const RecordedLook& look : run.looks) {
      worst_m = look.driven_m >= params.find_m ? std::max(worst_m, look.error_m) : worst_m;
    }
    text << run.building << ",\"" << run.method << "\"," << run.index << "," << run.start_s << ","
         << first.T_world_robot.x << "," << first.T_world_robot.y << "," << last.driven_m << ","
         << run.looks.size() << "," << run.is_right_from(params.find_m, params.within_m) << ","
         << run.found_m(params.within_m) << "," << last.error_m << "," << worst_m << ","
         << last.yaw_error_rad * 180.0 / kPi << "," << last.scale << "," << last.confidence << ","
         << last.is_converged << "\n";
  }
  return text.str();
}

std::string looks_csv_of(const std::vector<RecordedRun>& runs) {
  std::ostringstream text;
  text << "building,method,index,driven_m,error_m,yaw_error_deg,scale,confidence,converged,"
          "truth_x_m,truth_y_m,truth_yaw_deg\n"
       << std::fixed << std::setprecision(3);
  for (const RecordedRun& run : runs) {
    for (const RecordedLook& look : run.looks) {
      text << run.building << ",\"" << run.method << "\"," << run.index << "," << look.driven_m
           << "," << look.error_m << "," << look.yaw_error_rad * 180.0 / kPi << "," << look.scale
           << "," << look.confidence << "," << look.is_converged << "," << look.T_world_robot.x
           << "," << look.T_world_robot.y << "," << look.T_world_robot.yaw * 180.0 / kPi << "\n";
    }
  }
  return text.str();
}

std::string table_of(const std::vector<RecordedRun>& runs, const RecordedRunParams& params) {
  const std::vector<std::string> methods = names_of(runs, &RecordedRun::method);
  std::vector<std::string> buildings = names_of(runs, &RecordedRun::building);
  if (buildings.size() > 1) {
    buildings.emplace_back(kAll);
  }
  std::string head = "| building | runs |";
  std::string rule = "|---|---|";
  for (const std::string& method : methods) {
    head += " " + method + " |";
    rule += "---|";
  }
  std::string table = head + "\n" + rule + "\n";
  for (const std::string& building : buildings) {
    table += "| " + building + " | " +
             std::to_string(select(runs, building, methods.front()).size()) + " |";
    for (const std::string& method : methods) {
      table += " " + text_of(found_share(select(runs, building, method), params)) + " |";
    }
    table += "\n";
  }
  return table;
}

std::string results_of(const std::vector<RecordedRun>& runs, const RecordedRunParams& params) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3);
  for (const std::string& building : names_of(runs, &RecordedRun::building)) {
    for (const std::string& method : names_of(runs, &RecordedRun::method)) {
      const auto selected = select(runs, building, method);
      const Figure found = found_share(selected, params);
      text << "RESULT building=" << building << " method=\"" << method << "\" found=" << found.value
           << " low=" << found.low << " high=" << found.high << " runs=" << selected.size() << "\n";
    }
  }
  return text.str();
}

std::string recorded_plot(const std::vector<RecordedRun>& runs, const RecordedRunParams& params) {
  assert(!runs.empty());
  constexpr std::size_t kColumns = 3;
  constexpr double kWidth = 220.0;
  constexpr double kHeight = 150.0;
  constexpr double kRow = kHeight + 64.0;
  const std::vector<std::string> methods = names_of(runs, &RecordedRun::method);
  const std::vector<std::string> buildings = names_of(runs, &RecordedRun::building);
  const std::size_t columns = std::min(kColumns, buildings.size());
  const std::size_t rows = (buildings.size() + columns - 1) / columns;
  const double width = kPlotLeft + static_cast<double>(columns) * (kWidth + kPlotGap) + kPlotRight;
  const double legend_top = kPlotTop + static_cast<double>(rows) * kRow;
  Svg svg{width, legend_top + 18.0 * static_cast<double>(methods.size()) + 26.0};
  svg.text("Error of the estimate", {kPlotLeft, 20.0}, 13.0, kPlotInk, Align::kLeft, true);
  svg.text("recorded logs, unknown start", {kPlotLeft, 36.0}, kPlotFont, kPlotGrey);
  for (std::size_t b = 0; b < buildings.size(); ++b) {
    const double left = kPlotLeft + static_cast<double>(b % columns) * (kWidth + kPlotGap);
    const double top = kPlotTop + static_cast<double>(b / columns) * kRow;
    const PlotPanel panel{{left, top, kWidth, kHeight}, params.find_m + params.hold_m, 1.0};
    draw_rules(svg, panel, params, b % columns == 0);
    panel.draw_count_axis(svg, "driven [m]");
    svg.text(buildings[b], {left, top - 10.0}, kPlotFont, kPlotInk);
    if (b % columns == 0) {
      panel.draw_value_name(svg, "error [m]");
    }
    for (std::size_t m = methods.size(); m-- > 0;) {
      const auto selected = select(runs, buildings[b], methods[m]);
      if (!selected.empty()) {
        draw_curves(svg, panel, selected, stroke_of(m));
      }
    }
    panel.draw_axes(svg);
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const cv::Point2d at{kPlotLeft, legend_top + 18.0 * static_cast<double>(m)};
    svg.line(at, {at.x + 24.0, at.y}, stroke_of(m));
    svg.text(methods[m], {at.x + 30.0, at.y + 4.0}, kPlotFont);
  }
  svg.text("drawn through: median over the runs; dashed: quartiles; dotted: what is asked for",
           {kPlotLeft, legend_top + 18.0 * static_cast<double>(methods.size()) + 4.0}, 10.0,
           kPlotGrey);
  return svg.finished();
}

}  // namespace cmn
