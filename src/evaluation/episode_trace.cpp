// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_trace.hpp"

#include "coarse_map_nav/evaluation/canvas.hpp"
#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/localization_error.hpp"
#include "coarse_map_nav/evaluation/map_view.hpp"
#include "coarse_map_nav/evaluation/plot_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace cmn {
namespace {

// BGR. Blue and vermilion of Okabe and Ito (2008), and pale ones of both.
const cv::Scalar kRight{178, 114, 0};
const cv::Scalar kWrong{0, 94, 213};
const cv::Scalar kRightShade{247, 234, 218};
const cv::Scalar kWrongShade{205, 224, 250};
const cv::Scalar kUnsure{190, 182, 176};
const cv::Scalar kWay{60, 60, 60};
const cv::Scalar kRule{232, 228, 225};

constexpr double kMargin = 24.0;
constexpr double kTop = 84.0;
constexpr double kLetter = 9.5;
constexpr double kMapWidth = 760.0;
constexpr double kMapHeight = 620.0;
constexpr double kPlotsLeft = kMargin + kMapWidth + 70.0;
constexpr double kPlotsWidth = 330.0;
constexpr double kAround_m = 2.5;  ///< shown about the way
constexpr double kWallDepth_m = 0.15;

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// How it went, in a few words.
std::string short_outcome_of(const EpisodeRow& row) {
  return row.is_success ? text_of("at the goal after %d actions and %.1f m, SPL %.2f",
                                  row.success_actions, row.success_driven_m, row.spl())
                        : text_of("never nearer to the goal than %.1f m in %d actions",
                                  row.closest_m, row.actions);
}

std::string outcome_of(const EpisodeRow& row) {
  const char* said = !row.is_declared        ? "did not say so"
                     : row.is_declared_right ? "said so, rightly"
                                             : "said so elsewhere";
  return short_outcome_of(row) +
         text_of("; shortest way %.1f m; %s; %d collisions", row.shortest_m, said, row.collisions);
}

cv::Scalar colour_of_method(const std::string& method, const std::vector<std::string>& methods) {
  unsigned red = 0;
  unsigned green = 0;
  unsigned blue = 0;
  std::sscanf(method_stroke(method, methods).colour.c_str(), "#%2x%2x%2x", &red, &green, &blue);
  return {double(blue), double(green), double(red)};
}

/// Metres that people like, for a bar of about a fifth of the width.
double bar_length_m(const MapView& view) {
  const double wanted_m = view.area.width / view.scale() / 5.0;
  double length_m = 0.5;
  for (const double candidate_m : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    length_m = candidate_m <= wanted_m ? candidate_m : length_m;
  }
  return length_m;
}

void draw_scale_bar(Canvas& canvas, const MapView& view, double y) {
  const double length_m = bar_length_m(view);
  const double right = kMargin + kMapWidth;  // clear of the legend, however narrow the map
  const double left = right - length_m * view.scale();
  canvas.polyline({{left, y - 4.0}, {left, y}, {right, y}, {right, y - 4.0}}, kMapColours.ink, 1.5);
  canvas.text(text_of("%g m", length_m), {left - 8.0, y}, kLetter, kMapColours.ink, Align::kRight);
}

/// The way on the map; in two pieces when the robot was kidnapped.
std::vector<std::vector<cv::Point2d>> ways_on(const MapView& view,
                                              const std::vector<TraceStep>& steps) {
  constexpr double kLeap_m = 0.5;  ///< no action takes the robot so far
  std::vector<std::vector<cv::Point2d>> ways(1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Point2 p = steps[i].T_world_robot.position();
    if (i > 0 && norm(p - steps[i - 1].T_world_robot.position()) > kLeap_m) {
      ways.emplace_back();
    }
    ways.back().push_back(view.at(p));
  }
  return ways;
}

void draw_way(Canvas& canvas, const MapView& view, const std::vector<TraceStep>& steps,
              const cv::Scalar& colour, double width) {
  const auto ways = ways_on(view, steps);
  for (const auto& way : ways) {
    canvas.polyline(way, kMapColours.white, 3.6);
  }
  for (const auto& way : ways) {
    canvas.polyline(way, colour, width);
  }
}

void draw_ends(Canvas& canvas, const MapView& view, const EpisodeTrace& trace) {
  std::vector<cv::Point2d> ring;
  for (int i = 0; i <= 48; ++i) {
    ring.push_back(view.at(trace.row.goal_world +
                           turned(Point2{trace.success_radius_m, 0.0}, i * 2.0 * kPi / 48)));
  }
  canvas.polyline(ring, kMapColours.goal, 1.2);
  draw_goal(canvas, view.at(trace.row.goal_world), 8.0);
  draw_start(canvas, view.at(trace.row.T_world_start.position()), 6.5);
  if (trace.row.drop_actions >= 0) {
    const cv::Point2d drop = view.at(trace.row.T_world_drop.position());
    draw_start(canvas, drop, 6.5);
    canvas.text("put down here", {drop.x + 11.0, drop.y + 4.0}, kLetter, kMapColours.ink);
  }
}

/// The world around some points, its frame and scale.
MapView draw_world(Canvas& canvas, const CoarseMap& world, double height) {
  const MapView view = view_in(world, {kMargin, kTop}, {kMapWidth, height});
  canvas.picture(walls_of(world, kWallDepth_m), view.area);
  canvas.frame(view.area, kMapColours.faint_ink, 0.5);
  draw_scale_bar(canvas, view, view.area.br().y + 20.0);
  return view;
}

double drawn_height(const CoarseMap& world) {
  return std::min(kMapHeight, kMapWidth * world.height() / world.width());
}

void draw_estimates(Canvas& canvas, const MapView& view, const EpisodeTrace& trace) {
  for (const bool is_sure : {false, true}) {  // those that matter on top
    for (const TraceStep& step : trace.steps) {
      const cv::Point2d at = view.at(step.T_world_estimate.position());
      const bool is_due = (step.confidence >= trace.converged_confidence) == is_sure;
      if (is_due && view.area.contains(at)) {
        canvas.disc(at, is_sure ? 2.4 : 1.8,
                    !is_sure          ? kUnsure
                    : step.is_right() ? kRight
                                      : kWrong);
      }
    }
  }
}

void draw_collisions(Canvas& canvas, const MapView& view, const std::vector<TraceStep>& steps) {
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].collisions > steps[i - 1].collisions) {
      const cv::Point2d p = view.at(steps[i].T_world_robot.position());
      for (const double slant : {-1.0, 1.0}) {
        canvas.polyline({{p.x - 4.0, p.y - 4.0 * slant}, {p.x + 4.0, p.y + 4.0 * slant}},
                        kMapColours.ink, 1.6);
      }
    }
  }
}

/// Samples of what is on the map, left to right, two rows.
void draw_trace_legend(Canvas& canvas, cv::Point2d at) {
  const double left = at.x;
  const auto name = [&](const std::string& text) {
    canvas.text(text, {at.x + 16.0, at.y + 4.0}, kLetter, kMapColours.ink);
    at.x += 16.0 + Canvas::text_width(text, kLetter) + 26.0;
  };
  draw_start(canvas, at, 6.0);
  name("start");
  draw_goal(canvas, at, 7.0);
  name("goal, success radius");
  canvas.polyline({{at.x - 10.0, at.y}, {at.x + 10.0, at.y}}, kWay, 1.8);
  name("way driven");
  for (const double slant : {-1.0, 1.0}) {
    canvas.polyline({{at.x - 4.0, at.y - 4.0 * slant}, {at.x + 4.0, at.y + 4.0 * slant}},
                    kMapColours.ink, 1.6);
  }
  name("collision");
  at = {left, at.y + 22.0};
  const std::array<std::pair<cv::Scalar, const char*>, 3> dots{
      {{kRight, "estimate, converged, right"},
       {kWrong, "converged, wrong"},
       {kUnsure, "not converged"}}};
  for (const auto& [colour, text] : dots) {
    canvas.disc(at, 4.0, colour);
    name(text);
  }
}

/// A curve by action in a panel of its own.
struct Strip {
  std::string name;
  double top_value;
  double rule_step;
  std::function<double(const TraceStep&)> value;
};

void draw_strip(Canvas& canvas, const cv::Rect2d& area, const Strip& strip,
                const EpisodeTrace& trace) {
  const std::vector<TraceStep>& steps = trace.steps;
  const PlotPanel panel{area, std::max(1.0, static_cast<double>(steps.size()) - 1.0),
                        strip.top_value};
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (steps[i].confidence >= trace.converged_confidence) {
      const double left = panel.at(static_cast<double>(i), 0.0).x;
      const double right = panel.at(static_cast<double>(i + 1), 0.0).x;
      canvas.fill({left, area.y, right - left, area.height},
                  steps[i].is_right() ? kRightShade : kWrongShade);
    }
  }
  for (double v = 0.0; v <= strip.top_value * 1.0001; v += strip.rule_step) {
    const cv::Point2d left = panel.at(0.0, v);
    canvas.polyline({left, {area.br().x, left.y}}, kRule, 1.0);
    canvas.text(text_of("%g", v), {left.x - 7.0, left.y + 4.0}, 8.5, kMapColours.faint_ink,
                Align::kRight);
  }
  std::vector<cv::Point2d> curve;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    curve.push_back(
        panel.at(static_cast<double>(i), std::clamp(strip.value(steps[i]), 0.0, strip.top_value)));
  }
  canvas.polyline(curve, kWay, 1.5);
  canvas.frame(area, kMapColours.faint_ink, 0.7);
  canvas.text(strip.name, {area.x, area.y - 7.0}, kLetter, kMapColours.ink);
}

/// A round value at or above `most`, and the step of its rules.
std::pair<double, double> round_top(double most) {
  double step = 0.5;
  for (const double candidate : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    step = step * 4.0 >= most ? step : candidate;
  }
  return {step * std::max(1.0, std::ceil(most / step)), step};
}

void draw_strips(Canvas& canvas, const EpisodeTrace& trace, double height) {
  double most_off_m = 1.0;
  double most_entropy = 1.0;
  for (const TraceStep& step : trace.steps) {
    most_off_m = std::max(most_off_m, step.off_m());
    most_entropy = std::max(most_entropy, step.entropy);
  }
  const auto [top_off_m, off_rule_m] = round_top(most_off_m);
  const auto [top_entropy, entropy_rule] = round_top(most_entropy);
  const std::array<Strip, 3> strips{
      {{"estimate off by [m]", top_off_m, off_rule_m, [](const auto& s) { return s.off_m(); }},
       {"confidence: belief within 1 m of the estimate", 1.0, 0.25,
        [](const auto& s) { return s.confidence; }},
       {"entropy of the belief [nats]", top_entropy, entropy_rule,
        [](const auto& s) { return s.entropy; }}}};
  constexpr double kBetween = 34.0;
  const double strip_height = (height - 2.0 * kBetween) / 3.0;
  double top = kTop;
  for (const Strip& strip : strips) {
    draw_strip(canvas, {kPlotsLeft, top, kPlotsWidth, strip_height}, strip, trace);
    top += strip_height + kBetween;
  }
  const double foot = kTop + height;
  const auto last = static_cast<double>(trace.steps.size() - 1);
  const double step = round_top(std::max(4.0, last)).second;
  for (double action = 0.0; action <= last; action += step) {
    const double x = kPlotsLeft + kPlotsWidth * action / std::max(1.0, last);
    canvas.polyline({{x, foot}, {x, foot + 4.0}}, kMapColours.faint_ink, 1.0);
    canvas.text(text_of("%g", action), {x, foot + 16.0}, 8.5, kMapColours.faint_ink,
                Align::kMiddle);
  }
  canvas.text("actions", {kPlotsLeft + kPlotsWidth / 2.0, foot + 34.0}, kLetter, kMapColours.ink,
              Align::kMiddle);
  double x = kPlotsLeft;
  for (const auto& [colour, text] :
       {std::pair{kRightShade, "converged, right"}, std::pair{kWrongShade, "converged, wrong"}}) {
    canvas.fill({x, foot + 46.0, 18.0, 12.0}, colour);
    canvas.frame({x, foot + 46.0, 18.0, 12.0}, kMapColours.faint_ink, 0.5);
    canvas.text(text, {x + 24.0, foot + 56.0}, kLetter, kMapColours.ink);
    x += 160.0;
  }
}

}  // namespace

double TraceStep::off_m() const {
  return norm(T_world_estimate.position() - T_world_robot.position());
}

bool TraceStep::is_right() const {
  return off_m() <= kRightWithin_m &&
         std::abs(wrap_angle(T_world_estimate.yaw - T_world_robot.yaw)) < kPi / 4.0;
}

cv::Mat trace_picture(const EpisodeTrace& trace) {
  if (trace.steps.empty()) {
    throw std::invalid_argument("an episode without a step cannot be drawn");
  }
  std::vector<Point2> points{trace.row.goal_world};
  for (const TraceStep& step : trace.steps) {
    points.push_back(step.T_world_robot.position());
    if (step.confidence >= trace.converged_confidence) {
      points.push_back(step.T_world_estimate.position());
    }
  }
  const CoarseMap world = cut_out(trace.world, points, kAround_m);
  const double height = drawn_height(world);
  const double body = std::max(height, 360.0);
  Canvas canvas{{cvRound(kPlotsLeft + kPlotsWidth + kMargin), cvRound(kTop + body + 76.0)},
                kMapColours.white};
  canvas.text(trace.row.key.id(), {kMargin, 30.0}, 14.0, kMapColours.ink, Align::kLeft, true);
  canvas.text(outcome_of(trace.row), {kMargin, 52.0}, kLetter, kMapColours.faint_ink);
  const MapView view = draw_world(canvas, world, height);
  draw_estimates(canvas, view, trace);
  draw_way(canvas, view, trace.steps, kWay, 1.8);
  draw_collisions(canvas, view, trace.steps);
  draw_ends(canvas, view, trace);
  const Pose2 last = trace.steps.back().T_world_robot;
  draw_robot(canvas, view.at(last.position()), 8.0, view.turned(last.yaw));
  draw_trace_legend(canvas, {kMargin + 10.0, kTop + height + 24.0});
  draw_strips(canvas, trace, body);
  return canvas.finished();
}

cv::Mat trace_comparison(const std::vector<EpisodeTrace>& traces) {
  if (traces.empty()) {
    throw std::invalid_argument("there is no episode to draw");
  }
  const EpisodeTrace& first = traces.front();
  std::vector<std::string> methods;
  std::vector<Point2> points{first.row.goal_world, first.row.T_world_start.position()};
  for (const EpisodeTrace& trace : traces) {
    EpisodeKey key = trace.row.key;
    key.method = first.row.key.method;
    if (!(key == first.row.key)) {
      throw std::invalid_argument(trace.row.key.id() + " is another episode than " +
                                  first.row.key.id());
    }
    methods.push_back(trace.row.key.method);
    for (const TraceStep& step : trace.steps) {
      points.push_back(step.T_world_robot.position());
    }
  }
  const CoarseMap world = cut_out(first.world, points, kAround_m);
  const double height = drawn_height(world);
  constexpr double kRow = 22.0;
  Canvas canvas{{cvRound(2.0 * kMargin + kMapWidth),
                 cvRound(kTop + height + 40.0 + kRow * static_cast<double>(traces.size() + 1))},
                kMapColours.white};
  std::string id = first.row.key.id();
  id.resize(id.size() - first.row.key.method.size() - 1);
  canvas.text(id, {kMargin, 30.0}, 14.0, kMapColours.ink, Align::kLeft, true);
  canvas.text(
      text_of("ways from one start to one goal, %.1f m away at least", first.row.shortest_m),
      {kMargin, 52.0}, kLetter, kMapColours.faint_ink);
  const MapView view = draw_world(canvas, world, height);
  cv::Point2d at{kMargin, kTop + height + 24.0};
  draw_start(canvas, {at.x + 10.0, at.y}, 6.0);
  canvas.text("start", {at.x + 26.0, at.y + 4.0}, kLetter, kMapColours.ink);
  draw_goal(canvas, {at.x + 96.0, at.y}, 7.0);
  canvas.text("goal, success radius", {at.x + 112.0, at.y + 4.0}, kLetter, kMapColours.ink);
  for (std::size_t i = traces.size(); i-- > 0;) {  // the first on top
    draw_way(canvas, view, traces[i].steps, colour_of_method(methods[i], methods), 2.2);
  }
  for (const EpisodeTrace& trace : traces) {
    at.y += kRow;
    canvas.polyline({at, {at.x + 24.0, at.y}}, colour_of_method(trace.row.key.method, methods),
                    2.6);
    canvas.text(method_label(trace.row.key.method), {at.x + 32.0, at.y + 4.0}, kLetter,
                kMapColours.ink);
    canvas.text(short_outcome_of(trace.row), {at.x + 120.0, at.y + 4.0}, kLetter,
                kMapColours.faint_ink);
  }
  draw_ends(canvas, view, first);
  return canvas.finished();
}

}  // namespace cmn
