// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/error_plot.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

const cv::Scalar kInk{60, 60, 60};
const cv::Scalar kRule{225, 225, 225};
const cv::Scalar kRight{70, 150, 50};
const cv::Scalar kWrong{50, 50, 210};
const cv::Scalar kRightShade{215, 240, 210};
const cv::Scalar kWrongShade{215, 215, 250};
const cv::Scalar kErrorLine{160, 80, 20};
constexpr int kWidth = 1000;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

/// A distance between rules that people like (1, 2 or 5 times a power of ten), for about `count`.
double rule_distance(double range, int count) {
  const double rough = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

std::string number_text(double value) {
  std::ostringstream text;
  text << std::setprecision(4) << value;
  return text.str();
}

void write(cv::Mat& image, const std::string& text, cv::Point at, double size = 0.5,
           const cv::Scalar& colour = kInk) {
  cv::putText(image, text, at, kFont, size, colour, 1, cv::LINE_AA);
}

void write_right_aligned(cv::Mat& image, const std::string& text, cv::Point at) {
  int base = 0;
  const cv::Size size = cv::getTextSize(text, kFont, 0.5, 1, &base);
  write(image, text, {at.x - size.width, at.y});
}

/// A rectangle of the picture with a time axis and a value axis.
struct Panel {
  cv::Rect area;
  double duration_s;
  double top_value;

  cv::Point at(double time_s, double value) const {
    const double x = area.x + time_s / duration_s * area.width;
    const double y = area.y + area.height * (1.0 - std::min(value / top_value, 1.0));
    return {cvRound(x), cvRound(y)};
  }
};

void draw_axes(cv::Mat& image, const Panel& panel, const std::string& name, bool with_times) {
  const double value_step = rule_distance(panel.top_value, 4);
  for (double v = 0.0; v <= panel.top_value * 1.0001; v += value_step) {
    const cv::Point left = panel.at(0.0, v);
    cv::line(image, left, {left.x + panel.area.width, left.y}, kRule);
    write_right_aligned(image, number_text(v), {left.x - 8, left.y + 5});
  }
  const double time_step = rule_distance(panel.duration_s, 8);
  for (double t = 0.0; t <= panel.duration_s; t += time_step) {
    const cv::Point foot = panel.at(t, 0.0);
    cv::line(image, foot, {foot.x, panel.area.y}, kRule);
    if (with_times) {
      write(image, number_text(t), {foot.x - 8, foot.y + 20});
    }
  }
  cv::rectangle(image, panel.area, kInk);
  write(image, name, {panel.area.x, panel.area.y - 8});
}

void shade(cv::Mat& image, const Panel& panel, const std::vector<LocalizationError>& errors) {
  const double start = errors.front().belief.stamp_s;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i].belief.converged) {
      continue;
    }
    const double from = errors[i].belief.stamp_s - start;
    const double to = i + 1 < errors.size() ? errors[i + 1].belief.stamp_s - start : from;
    cv::rectangle(image, panel.at(from, panel.top_value), panel.at(to, 0.0),
                  errors[i].is_right() ? kRightShade : kWrongShade, cv::FILLED);
  }
}

void draw_curve(cv::Mat& image, const Panel& panel, const std::vector<LocalizationError>& errors,
                const std::function<double(const LocalizationError&)>& value) {
  std::vector<cv::Point> points;
  for (const LocalizationError& error : errors) {
    points.push_back(panel.at(error.belief.stamp_s - errors.front().belief.stamp_s, value(error)));
  }
  cv::polylines(image, points, false, kErrorLine, 1, cv::LINE_AA);
}

void draw_legend(cv::Mat& image, cv::Point at) {
  for (const auto& [colour, text] :
       {std::pair{kRightShade, "converged, right"}, std::pair{kWrongShade, "converged, wrong"}}) {
    cv::rectangle(image, cv::Rect{at.x, at.y - 12, 18, 14}, colour, cv::FILLED);
    cv::rectangle(image, cv::Rect{at.x, at.y - 12, 18, 14}, kInk);
    write(image, text, {at.x + 26, at.y});
    at.x += 190;
  }
}

}  // namespace

cv::Mat error_plot(const std::vector<LocalizationError>& errors, const std::string& title) {
  double largest = 2.0 * kRightWithin_m;
  for (const LocalizationError& error : errors) {
    largest = std::max(largest, error.distance_m);
  }
  const double duration =
      std::max(1.0, errors.back().belief.stamp_s - errors.front().belief.stamp_s);
  const Panel error_panel{{70, 64, kWidth - 100, 230}, duration, 1.05 * largest};
  const Panel confidence_panel{{70, 330, kWidth - 100, 110}, duration, 1.0};
  cv::Mat image{490, kWidth, CV_8UC3, cv::Scalar::all(255)};
  for (const Panel& panel : {error_panel, confidence_panel}) {
    shade(image, panel, errors);
  }
  draw_axes(image, error_panel, "distance of the estimate from the truth [m]; dashed: 1 m", false);
  draw_axes(image, confidence_panel, "confidence", true);
  for (double t = 0.0; t < 0.999 * duration; t += duration / 60.0) {
    cv::line(image, error_panel.at(t, kRightWithin_m),
             error_panel.at(std::min(t + duration / 120.0, duration), kRightWithin_m), kRight, 1,
             cv::LINE_AA);
  }
  draw_curve(image, error_panel, errors, [](const auto& e) { return e.distance_m; });
  draw_curve(image, confidence_panel, errors, [](const auto& e) { return e.belief.confidence; });
  write(image, title, {70, 28}, 0.65);
  draw_legend(image, {kWidth - 410, 28});
  write(image, "time [s]", {kWidth / 2 - 30, 482});
  return image;
}

cv::Mat track_plot(const std::vector<LocalizationError>& errors, const CoarseMap& map) {
  const int scale = std::clamp(800 / std::max({1, map.width(), map.height()}), 1, 16);
  cv::Mat image{map.height() * scale, map.width() * scale, CV_8UC3, cv::Scalar::all(255)};
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_occupied(c)) {
      const cv::Rect box{c.x * scale, (map.height() - 1 - c.y) * scale, scale, scale};
      cv::rectangle(image, box, cv::Scalar{120, 110, 100}, cv::FILLED);
    }
  }
  const auto pixel_of = [&](const Pose2& pose) {
    const Point2 p = inverse(map.T_map_grid()) * pose.position();
    return cv::Point{cvRound(p.x / map.resolution() * scale),
                     cvRound((map.height() - p.y / map.resolution()) * scale)};
  };
  std::vector<cv::Point> path;
  for (const LocalizationError& error : errors) {
    path.push_back(pixel_of(error.T_world_robot));
  }
  cv::polylines(image, path, false, cv::Scalar{170, 170, 170}, 1, cv::LINE_AA);
  for (const LocalizationError& error : errors) {
    if (error.belief.converged) {
      cv::circle(image, pixel_of(error.belief.T_map_robot), std::max(2, scale / 3),
                 error.is_right() ? kRight : kWrong, cv::FILLED, cv::LINE_AA);
    }
  }
  return image;
}

}  // namespace cmn
