// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_picture.hpp"

#include "coarse_map_nav/evaluation/canvas.hpp"
#include "coarse_map_nav/evaluation/map_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

namespace cmn {
namespace {

using Points = std::vector<cv::Point2d>;

// BGR
const std::vector<cv::Scalar> kHeat{{255, 255, 255}, {178, 236, 255}, {76, 178, 254},
                                    {40, 90, 245},   {40, 20, 190},   {30, 0, 80}};
const std::vector<cv::Scalar> kTimes{{140, 60, 60}, {160, 130, 40}, {120, 175, 40}, {40, 205, 225}};

constexpr int kWidth = 1400;
constexpr double kMargin = 24.0;
constexpr double kLetter = 11.0;  ///< height of a capital

std::string text_of(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// The probability that is drawn white: a tenth of a uniform belief's.
double faint_on(const CoarseMap& map) {
  return 0.1 / static_cast<double>(std::max<std::size_t>(1, map.free_count()));
}

/// The truth as it would lie on the drawing: the warp bends directions, too.
std::optional<Pose2> on_drawing(const RunSetting& setting, const RunMoment& moment) {
  if (moment.T_map_robot) {
    return moment.T_map_robot;
  }
  if (!setting.warp || !moment.T_world_robot) {
    return std::nullopt;
  }
  const Point2 here = setting.warp->world_to_map(moment.T_world_robot->position());
  const Point2 ahead = setting.warp->world_to_map(*moment.T_world_robot * Point2{0.1, 0.0});
  return Pose2{here.x, here.y, std::atan2(ahead.y - here.y, ahead.x - here.x)};
}

void draw_drawing(Canvas& canvas, const MapView& view, const RunSetting& setting,
                  const RunMoment& moment) {
  const double symbol = std::clamp(0.9 * view.area.width / view.map->width(), 6.5, 9.5);
  canvas.picture(belief_cells(setting.map, moment.marginal), view.area);
  canvas.frame(view.area, kMapColours.faint_ink, 0.5);
  draw_goal(canvas, view.at(setting.goal_map), 1.1 * symbol);
  if (const std::optional<Pose2> truth = on_drawing(setting, moment)) {
    draw_robot(canvas, view.at(truth->position()), 1.05 * symbol, view.turned(truth->yaw));
  }
  draw_estimate(canvas, view.at(moment.T_map_estimate.position()), symbol,
                view.turned(moment.T_map_estimate.yaw), moment.converged);
}

/// The true path up to a time.
void draw_track(Canvas& canvas, const MapView& view, const RunRecord& record, double until_s) {
  Points points;
  std::vector<double> shares;
  for (const TrackPoint& point : record.track()) {
    if (point.time_s <= until_s) {
      points.push_back(view.at(point.T_world_robot.position()));
      shares.push_back(point.time_s / std::max(1e-9, record.duration_s()));
    }
  }
  canvas.polyline(points, kMapColours.white, 6.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    canvas.polyline({points[i - 1], points[i]}, colour_at(kTimes, shares[i]), 3.0);
  }
}

void draw_world(Canvas& canvas, const MapView& view, const RunSetting& setting,
                const RunRecord& record, double until_s, double symbol) {
  canvas.picture(walls_of(*view.map), view.area);
  canvas.frame(view.area, kMapColours.faint_ink, 0.5);
  draw_track(canvas, view, record, until_s);
  if (setting.goal_world) {
    draw_goal(canvas, view.at(*setting.goal_world), 1.1 * symbol);
  }
  if (record.track().empty()) {
    return;
  }
  draw_start(canvas, view.at(record.track().front().T_world_robot.position()), 0.75 * symbol);
  const Pose2 robot = record.truth_at(until_s).value_or(record.track().front().T_world_robot);
  draw_robot(canvas, view.at(robot.position()), 0.9 * symbol, view.turned(robot.yaw));
}

void draw_scale(Canvas& canvas, const std::vector<cv::Scalar>& scale, const cv::Rect2d& area) {
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const double step = area.width / kSteps;
    canvas.fill({area.x + i * step, area.y, step, area.height},
                colour_at(scale, (i + 0.5) / kSteps));
  }
  canvas.frame(area, kMapColours.faint_ink, 0.5);
}

/// The symbols, left to right, then the two colour scales in a second row.
void draw_legend(Canvas& canvas, cv::Point2d at, const RunSetting& setting,
                 const RunRecord& record) {
  constexpr double kSymbol = 8.0;
  const auto entry = [&](const std::string& text) {
    canvas.text(text, {at.x + 14.0, at.y + 5.0}, kLetter * 0.92, kMapColours.ink);
    at.x += 14.0 + Canvas::text_width(text, kLetter * 0.92) + 34.0;
  };
  draw_goal(canvas, at, kSymbol);
  entry("goal");
  if (setting.world) {
    draw_start(canvas, at, kSymbol * 0.75);
    entry("start");
  }
  if (setting.world || setting.warp) {
    draw_robot(canvas, at, kSymbol * 0.9, 0.0);
    entry("robot (truth)");
  }
  draw_estimate(canvas, at, kSymbol, 0.0, true);
  entry("estimate");
  draw_estimate(canvas, at, kSymbol, 0.0, false);
  entry("estimate, filter unsure");

  const double p_faint = faint_on(setting.map);
  constexpr double kScaleWidth = 190.0;
  canvas.text("belief", {at.x - 8.0, at.y + 5.0}, kLetter * 0.92, kMapColours.ink);
  at.x += 52.0;
  draw_scale(canvas, kHeat, {at.x, at.y - 7.0, kScaleWidth, 12.0});
  for (double p = 1.0; p > p_faint; p /= 10.0) {
    const double share = std::log(p / p_faint) / std::log(1.0 / p_faint);
    canvas.text(p == 1.0 ? "1" : text_of("%.4g", p), {at.x + share * kScaleWidth, at.y + 20.0},
                kLetter * 0.72, kMapColours.faint_ink, Align::kMiddle);
  }
  at.x += kScaleWidth + 34.0;
  if (setting.world) {
    canvas.text("time", {at.x, at.y + 5.0}, kLetter * 0.92, kMapColours.ink);
    at.x += 46.0;
    draw_scale(canvas, kTimes, {at.x, at.y - 7.0, 110.0, 12.0});
    canvas.text("0", {at.x, at.y + 20.0}, kLetter * 0.72, kMapColours.faint_ink, Align::kMiddle);
    canvas.text(text_of("%.0f ", record.duration_s()) + setting.time_unit,
                {at.x + 110.0, at.y + 20.0}, kLetter * 0.72, kMapColours.faint_ink, Align::kMiddle);
  }
}

void check(const RunSetting& setting, const RunRecord& record) {
  if (record.moments().empty()) {
    throw std::invalid_argument("a journey without a single belief cannot be drawn");
  }
  for (const RunMoment& moment : record.moments()) {
    if (moment.marginal.width() != setting.map.width() ||
        moment.marginal.height() != setting.map.height()) {
      throw std::invalid_argument("the belief does not have the size of the drawing");
    }
  }
}

/// The moment nearest to a time.
const RunMoment& moment_at(const RunRecord& record, double time_s) {
  return *std::min_element(record.moments().begin(), record.moments().end(),
                           [&](const RunMoment& a, const RunMoment& b) {
                             return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
                           });
}

std::string caption_of(const RunSetting& setting, const RunMoment& moment) {
  return text_of("%.0f ", std::max(0.0, moment.time_s)) + setting.time_unit + ", " +
         text_of("%.0f %% sure", 100.0 * moment.confidence);
}

/// How tall a map is when it is `width` wide, at most `most`.
double height_of(const CoarseMap& map, double width, double most) {
  return std::min(most, width * map.height() / map.width());
}

}  // namespace

cv::Scalar heat_colour(double probability, double p_faint) {
  if (!(probability > p_faint)) {
    return kHeat.front();
  }
  return colour_at(kHeat, std::log(probability / p_faint) / std::log(1.0 / p_faint));
}

cv::Mat belief_cells(const CoarseMap& map, const Grid<float>& marginal) {
  cv::Mat image = walls_of(map);
  const double p_faint = faint_on(map);
  for (std::size_t i = 0; i < marginal.size(); ++i) {
    const Cell c = marginal.cell_at(i);
    if (map.is_free(c)) {
      const cv::Scalar colour = heat_colour(static_cast<double>(marginal[i]), p_faint);
      auto& pixel = image.at<cv::Vec3b>(map.height() - 1 - c.y, c.x);
      for (int k = 0; k < 3; ++k) {
        pixel[k] = cv::saturate_cast<uchar>(colour[k]);
      }
    }
  }
  return image;
}

cv::Mat run_picture(const RunSetting& setting, const RunRecord& record, const std::string& title,
                    const std::string& subtitle) {
  check(setting, record);
  constexpr double kTop = 104.0;
  constexpr double kCaption = 30.0;
  constexpr double kBetween = kCaption + 12.0;
  // The world is as tall as two drawings, one above the other, where that leaves them large enough.
  double width = (kWidth - 3.0 * kMargin) / 2.0;
  if (setting.world) {
    const double panels = kWidth - 4.0 * kMargin;
    const double world_rise = setting.world->height() / static_cast<double>(setting.world->width());
    const double map_rise = setting.map.height() / static_cast<double>(setting.map.width());
    width = std::clamp((panels * world_rise - kBetween) / (2.0 * (map_rise + world_rise)),
                       0.2 * panels, 0.35 * panels);
  }
  const double world_width = kWidth - 2.0 * width - 4.0 * kMargin;
  const double left = setting.world ? world_width + 2.0 * kMargin : kMargin;
  const double height = height_of(setting.map, width, 900.0);
  const double world_height = setting.world ? height_of(*setting.world, world_width, 1600.0) : 0.0;
  const double body = std::max(world_height, 2.0 * height + kBetween);

  Canvas canvas{{kWidth, cvRound(kTop + body + 74.0)}, kMapColours.paper};
  const double room = kWidth - 2.0 * kMargin;
  canvas.text_within(room, title, {kMargin, 40.0}, 17.0, kMapColours.ink, true);
  canvas.text_within(room, subtitle, {kMargin, 66.0}, kLetter, kMapColours.faint_ink);
  if (setting.world) {
    canvas.text("the world, and the way driven", {kMargin, kTop - 8.0}, kLetter, kMapColours.ink);
    const MapView view = view_in(*setting.world, {kMargin, kTop}, {world_width, world_height});
    draw_world(canvas, view, setting, record, record.duration_s(), 9.0);
  }
  const std::array<const char*, 4> names{"start", "at 1/3", "at 2/3", "end"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const RunMoment& moment =
        i == 0   ? record.moments().front()
        : i == 3 ? record.moments().back()
                 : moment_at(record, static_cast<double>(i) / 3.0 * record.moments().back().time_s);
    const cv::Point2d corner{left + static_cast<double>(i % 2) * (width + kMargin),
                             kTop + static_cast<double>(i / 2) * (height + kBetween)};
    canvas.text(std::string{names[i]} + ": " + caption_of(setting, moment),
                {corner.x, corner.y - 8.0}, kLetter, kMapColours.ink);
    draw_drawing(canvas, view_in(setting.map, corner, {width, height}), setting, moment);
  }
  draw_legend(canvas, {kMargin + 10.0, kTop + body + 38.0}, setting, record);
  return canvas.finished();
}

std::vector<FilmFrame> run_film(const RunSetting& setting, const RunRecord& record,
                                const std::string& title, const std::string& ending,
                                std::size_t most_frames) {
  check(setting, record);
  constexpr double kTop = 62.0;
  constexpr double kPanel = 440.0;
  constexpr double kGap = 16.0;
  const double height = std::max(height_of(setting.map, kPanel, kPanel),
                                 setting.world ? height_of(*setting.world, kPanel, kPanel) : 0.0);
  const int panels = setting.world ? 2 : 1;
  const cv::Size size{cvRound(panels * (kPanel + kGap) + kGap), cvRound(kTop + height + kGap)};
  const std::size_t count = std::clamp<std::size_t>(most_frames, 1, record.moments().size());
  std::vector<FilmFrame> film;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_last = i + 1 == count;
    const RunMoment& moment =
        is_last ? record.moments().back()
                : record.moments()[i * (record.moments().size() - 1) / (count - 1)];
    Canvas canvas{size, kMapColours.paper};
    const double room = size.width - 2.0 * kGap;
    canvas.text_within(room, title, {kGap, 24.0}, 12.0, kMapColours.ink, true);
    canvas.text_within(room, caption_of(setting, moment) + (is_last ? ": " + ending : ""),
                       {kGap, 48.0}, 10.0, is_last ? kMapColours.ink : kMapColours.faint_ink);
    draw_drawing(canvas, view_in(setting.map, {kGap, kTop}, {kPanel, height}), setting, moment);
    if (setting.world) {
      draw_world(canvas, view_in(*setting.world, {2.0 * kGap + kPanel, kTop}, {kPanel, height}),
                 setting, record, is_last ? record.duration_s() : moment.time_s, 8.0);
    }
    film.push_back({canvas.finished(), is_last ? 3.0 : i == 0 ? 1.0 : 0.1});
  }
  return film;
}

}  // namespace cmn
