// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/training_log.hpp"

#include "coarse_map_nav/evaluation/plot_panel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>

namespace cmn {
namespace {

/// A curve over the epochs.
struct Curve {
  const char* name;
  Stroke stroke;
  double EpochRow::*value;
};

std::string number(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string field(const char* format, double value) {
  return std::isfinite(value) ? number(format, value) : "";
}

void draw_curves(Svg& svg, const PlotPanel& panel, const std::vector<Curve>& curves,
                 const std::vector<EpochRow>& rows) {
  double x = panel.area.x;
  for (const Curve& curve : curves) {
    std::vector<cv::Point2d> points;
    for (const EpochRow& row : rows) {
      const double value = row.*curve.value;
      if (std::isfinite(value)) {
        points.push_back(panel.at(row.epoch, std::min(value, panel.y_max)));
      }
    }
    if (points.empty()) {
      continue;
    }
    svg.polyline(points, curve.stroke);
    svg.disc(points.back(), 2.5, curve.stroke.colour);
    svg.line({x, panel.area.y - 14.0}, {x + 16.0, panel.area.y - 14.0}, curve.stroke);
    svg.text(curve.name, {x + 20.0, panel.area.y - 10.0}, kPlotFont, kPlotInk);
    x += 30.0 + Svg::text_width(curve.name, kPlotFont);
  }
}

void draw_loss_rules(Svg& svg, const PlotPanel& panel) {
  constexpr int kRules = 5;
  for (int i = 0; i <= kRules; ++i) {
    const double value = panel.y_max * i / kRules;
    const cv::Point2d left = panel.at(0.0, value);
    svg.line(left, {panel.area.br().x, left.y}, {"#e3e6ea", 1.0, ""});
    svg.text(number("%.2f", value), {left.x - 7.0, left.y + 3.5}, 10.0, kPlotGrey, Align::kRight);
  }
}

}  // namespace

std::string training_csv(const std::vector<EpochRow>& rows) {
  std::ostringstream csv;
  csv << "epoch,seconds,learning_rate,train_loss,validation_loss,ap_free,iou_free,ece,"
         "wide_ap_free\n";
  for (const EpochRow& row : rows) {
    csv << row.epoch << "," << field("%.0f", row.seconds) << "," << field("%.3g", row.learning_rate)
        << "," << field("%.6f", row.train_loss) << "," << field("%.6f", row.validation_loss) << ","
        << field("%.5f", row.average_precision) << "," << field("%.5f", row.iou) << ","
        << field("%.5f", row.calibration_error) << "," << field("%.5f", row.wide_average_precision)
        << "\n";
  }
  return csv.str();
}

std::string training_plot(const std::vector<EpochRow>& rows, const std::string& title) {
  assert(!rows.empty());
  constexpr double kWidth = 340.0;
  constexpr double kHeight = 220.0;
  constexpr double kBetween = 70.0;
  const std::vector<Curve> losses{{"training", {"#0072b2", 1.7, ""}, &EpochRow::train_loss},
                                  {"validation", {"#d55e00", 1.7, ""}, &EpochRow::validation_loss}};
  const std::vector<Curve> shares{
      {"AP, near", {"#0072b2", 1.7, ""}, &EpochRow::average_precision},
      {"AP, wide", {"#56b4e9", 1.7, "6 2.5"}, &EpochRow::wide_average_precision},
      {"IoU, near", {"#009e73", 1.7, ""}, &EpochRow::iou},
      {"calibration error, near", {"#d55e00", 1.7, ""}, &EpochRow::calibration_error}};
  double worst = 0.0;
  for (const EpochRow& row : rows) {
    worst = std::max({worst, row.train_loss, row.validation_loss});
  }
  const double epochs = std::max(1, rows.back().epoch);
  const PlotPanel left{{kPlotLeft, kPlotTop, kWidth, kHeight}, epochs, std::max(worst, 1e-6)};
  const PlotPanel right{{kPlotLeft + kWidth + kBetween, kPlotTop, kWidth, kHeight}, epochs, 1.0};
  Svg svg{right.area.br().x + kPlotRight, right.area.br().y + 44.0};
  svg.text(title, {kPlotLeft, 20.0}, 13.0, kPlotInk, Align::kLeft, true);
  draw_loss_rules(svg, left);
  right.draw_percent_rules(svg, true);
  for (const PlotPanel& panel : {left, right}) {
    panel.draw_count_axis(svg, "epoch");
    panel.draw_axes(svg);
  }
  left.draw_value_name(svg, "loss [nat]");
  right.draw_value_name(svg, "free space, validation [%]");
  draw_curves(svg, left, losses, rows);
  draw_curves(svg, right, shares, rows);
  return svg.finished();
}

}  // namespace cmn
