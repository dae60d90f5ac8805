// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/explanation.hpp"

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/evaluation/canvas.hpp"
#include "coarse_map_nav/evaluation/map_view.hpp"
#include "coarse_map_nav/evaluation/run_picture.hpp"
#include "coarse_map_nav/localization/ray_profile.hpp"
#include "coarse_map_nav/localization/scale_filter.hpp"
#include "coarse_map_nav/navigator.hpp"
#include "coarse_map_nav/planning/local_lattice.hpp"
#include "coarse_map_nav/planning/repaired_cost_to_go.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

namespace cmn {
namespace {

constexpr double kSide = 420.0;  ///< of what a panel shows
constexpr double kMargin = 16.0;
constexpr double kHead = 54.0;
constexpr double kLetter = 9.5;
const cv::Scalar kOpened{90, 160, 40};
const cv::Scalar kBlocked{40, 50, 200};
const cv::Scalar kRay{215, 170, 90};
const std::vector<cv::Scalar> kCosts{{170, 120, 40}, {120, 175, 40}, {40, 205, 225}};

std::string text_of(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

ExplanationPanel panel(const std::string& name, const std::string& title, const std::string& text,
                       const std::function<void(Canvas&, const cv::Rect2d&)>& draw) {
  Canvas canvas{{cvRound(kSide + 2.0 * kMargin), cvRound(kSide + kHead + kMargin)},
                kMapColours.paper};
  canvas.text(title, {kMargin, 22.0}, kLetter * 1.15, kMapColours.ink, Align::kLeft, true);
  canvas.text(text, {kMargin, 42.0}, kLetter * 0.9, kMapColours.faint_ink);
  draw(canvas, {kMargin, kHead, kSide, kSide});
  return {name, canvas.finished()};
}

/// A local occupancy grid on a square of the canvas, turned by quarters so that it lies as the
/// drawing does.
struct LocalView {
  const LocalOccupancy& local;
  cv::Rect2d area;
  int quarters;

  cv::Point2d at(Point2 p_robot) const {
    const Point2 p = turned(p_robot, quarters * kPi / 2.0);
    const double scale = area.width / local.side_m();
    return {area.x + area.width / 2.0 + p.x * scale, area.y + area.height / 2.0 - p.y * scale};
  }
};

/// Dark where occupied, white where free, paper where nothing is known.
void draw_local(Canvas& canvas, const LocalView& view) {
  const LocalOccupancy& local = view.local;
  cv::Mat image(local.size, local.size, CV_8UC3, kMapColours.paper);
  for (int iy = 0; iy < local.size; ++iy) {
    for (int ix = 0; ix < local.size; ++ix) {
      const std::size_t i = local.index_of(ix, iy);
      const double known = std::min(1.0, 4.0 * static_cast<double>(local.confidence[i]));
      const auto occupied = static_cast<double>(local.occupancy[i]);
      const cv::Scalar seen = occupied * kMapColours.wall + (1.0 - occupied) * kMapColours.white;
      const cv::Scalar colour = known * seen + (1.0 - known) * cv::Scalar{222, 224, 226};
      const Cell c = turned(Cell{2 * ix + 1 - local.size, 2 * iy + 1 - local.size}, view.quarters);
      image.at<cv::Vec3b>(local.size - 1 - (c.y + local.size - 1) / 2, (c.x + local.size - 1) / 2) =
          cv::Vec3b(cv::saturate_cast<uchar>(colour[0]), cv::saturate_cast<uchar>(colour[1]),
                    cv::saturate_cast<uchar>(colour[2]));
    }
  }
  canvas.picture(image, view.area);
  canvas.frame(view.area, kMapColours.faint_ink, 0.5);
}

ExplanationPanel look_panel(const EpisodeMoment& moment, int quarters, double reach_m) {
  const LocalOccupancy& seen = moment.seen;
  return panel(
      "look", "What is seen",
      text_of("local occupancy, %.3g m a side, and the rays cast through it", seen.side_m()),
      [&](Canvas& canvas, const cv::Rect2d& area) {
        const LocalView view{seen, area, quarters};
        draw_local(canvas, view);
        const RayProfile rays = cast_rays(seen, 0.0, reach_m);
        for (int b = 0; b < kBearings; ++b) {
          const Ray& ray = rays[static_cast<std::size_t>(b)];
          const Point2 end = turned(Point2{ray.range_m, 0.0}, bearing_rad(b));
          canvas.polyline({view.at({}), view.at(end)}, kRay, 1.0);
          if (ray.is_hit) {
            canvas.disc(view.at(end), 3.0, kMapColours.estimate);
          }
        }
        draw_robot(canvas, view.at({}), 9.0, quarters * kPi / 2.0);
      });
}

/// A belief on the drawing, with its best place, the truth and the goal.
ExplanationPanel belief_panel(const std::string& name, const std::string& title,
                              const EpisodeMoment& moment, const Localization& at) {
  std::string text = text_of("within 1 m of its best place lie %.1f %%", 100.0 * at.confidence);
  text += text_of(", entropy %.2f nats", entropy(at.belief));
  return panel(name, title, text, [&](Canvas& canvas, const cv::Rect2d& area) {
    const MapView view = view_in(moment.map, area.tl(), area.size());
    const Grid<double> cells = marginal(at.belief);
    Grid<float> shown{cells.width(), cells.height()};
    std::copy(cells.values().begin(), cells.values().end(), shown.values().begin());
    canvas.picture(belief_cells(moment.map, shown), view.area);
    canvas.frame(view.area, kMapColours.faint_ink, 0.5);
    draw_goal(canvas, view.at(moment.goal_map), 8.0);
    draw_robot(canvas, view.at(moment.T_map_true.position()), 8.0,
               view.turned(moment.T_map_true.yaw));
    const Pose2 best = pose_in_map(moment.map, at);
    draw_estimate(canvas, view.at(best.position()), 7.5, view.turned(best.yaw), at.is_converged);
  });
}

ExplanationPanel one_look_panel(const std::string& name, const std::string& title,
                                const EpisodeMoment& moment, const LocalizationParams& params,
                                const ScaleFilterParams& model) {
  ScaleFilter filter{moment.map, model, params.converged_confidence};
  filter.update(moment.seen, moment.T_odom_robot);
  return belief_panel(name, title, moment, filter.localization());
}

ExplanationPanel scales_panel(const ScaleFilter& filter, double true_scale) {
  const std::vector<double> mass = filter.scale_marginal();
  const std::string text =
      text_of("estimate %.2f drawn metres a metre", filter.localization().scale) +
      text_of(", the drawing's is %.2f", true_scale);
  return panel(
      "scales", "Belief over the scale", text, [&](Canvas& canvas, const cv::Rect2d& area) {
        const double step = area.width / static_cast<double>(mass.size());
        const double floor = area.br().y - 24.0;
        const double height = floor - area.y - 20.0;
        const auto x_of = [&](double scale) {  // bars stand evenly in log
          const double first = std::log(filter.scale_of(0));
          const double per_bar = mass.size() < 2 ? 1.0 : std::log(filter.scale_of(1)) - first;
          return area.x + ((std::log(scale) - first) / per_bar + 0.5) * step;
        };
        for (std::size_t i = 0; i < mass.size(); ++i) {
          const double scale = filter.scale_of(static_cast<int>(i));
          const double x = x_of(scale);
          canvas.fill({x - 0.32 * step, floor - height * mass[i], 0.64 * step, height * mass[i]},
                      kMapColours.estimate);
          canvas.text(text_of("%.2f", scale), {x, floor + 18.0}, kLetter, kMapColours.ink,
                      Align::kMiddle);
          canvas.text(text_of("%.2f", mass[i]), {x, floor - height * mass[i] - 6.0}, kLetter * 0.9,
                      kMapColours.faint_ink, Align::kMiddle);
        }
        canvas.polyline({{area.x, floor}, {area.br().x, floor}}, kMapColours.ink, 1.0);
        const double x = std::clamp(x_of(true_scale), area.x, area.br().x);
        canvas.polyline({{x, area.y}, {x, floor}}, kMapColours.truth, 2.0);
      });
}

ExplanationPanel lattice_panel(const EpisodeMoment& moment, const PlanningParams& params,
                               int quarters) {
  return panel(
      "lattice", "What can be driven to",
      text_of("poses within %.3g m by cost, blue cheap, yellow dear", params.lattice.reach_m),
      [&](Canvas& canvas, const cv::Rect2d& area) {
        const LocalView view{moment.local_map, area, quarters};
        draw_local(canvas, view);
        LocalLattice lattice{params.lattice, params.step_m};
        const std::vector<LatticeState>& states = lattice.search(moment.local_map);
        const double most = std::max(1e-6, states.back().cost_m);
        for (auto state = states.rbegin(); state != states.rend(); ++state) {
          canvas.disc(view.at(lattice.position_of(*state)), 3.5,
                      colour_at(kCosts, state->cost_m / most));
        }
        draw_robot(canvas, view.at({}), 9.0, quarters * kPi / 2.0);
      });
}

Point2 cells_of(const CoarseMap& map, Point2 p_map) {
  const Point2 p = inverse(map.T_map_grid()) * p_map;
  return (1.0 / map.resolution()) * p;
}

ExplanationPanel repaired_panel(const EpisodeMoment& moment, const RepairedMap& repaired) {
  return panel("repaired_map", "What was learned about the drawing",
               "green: a wall found open; red: found blocked; blue: the way",
               [&](Canvas& canvas, const cv::Rect2d& area) {
                 const MapView view = view_in(moment.map, area.tl(), area.size());
                 const CoarseMap now = repaired.as_map();
                 cv::Mat image(now.height(), now.width(), CV_8UC3);
                 for (std::size_t i = 0; i < now.occupied().size(); ++i) {
                   const Cell part = now.occupied().cell_at(i);
                   const bool is_drawn =
                       moment.map.is_occupied({part.x / repaired.cuts(), part.y / repaired.cuts()});
                   const cv::Scalar& colour = now.is_occupied(part)
                                                  ? (is_drawn ? kMapColours.wall : kBlocked)
                                                  : (is_drawn ? kOpened : kMapColours.white);
                   image.at<cv::Vec3b>(now.height() - 1 - part.y, part.x) = cv::Vec3b(
                       cv::saturate_cast<uchar>(colour[0]), cv::saturate_cast<uchar>(colour[1]),
                       cv::saturate_cast<uchar>(colour[2]));
                 }
                 canvas.picture(image, view.area);
                 canvas.frame(view.area, kMapColours.faint_ink, 0.5);
                 // The way to the goal by what is known now, through the walls if need be.
                 const RepairedCostToGo cost_to_go{
                     repaired, repaired.part_of(cells_of(moment.map, moment.goal_map))};
                 std::vector<cv::Point2d> way;
                 const double part = view.area.width / now.width();
                 for (std::optional<Cell> at = repaired.part_of(moment.localization.position_cells);
                      at; at = cost_to_go.next(*at)) {
                   const Point2 p = middle_of(*at);
                   way.emplace_back(view.area.x + p.x * part, view.area.br().y - p.y * part);
                 }
                 canvas.polyline(way, kMapColours.estimate, 1.5);
                 draw_goal(canvas, view.at(moment.goal_map), 8.0);
                 draw_robot(canvas, view.at(moment.T_map_true.position()), 8.0,
                            view.turned(moment.T_map_true.yaw));
               });
}

}  // namespace

std::vector<ExplanationPanel> explain(const EpisodeMoment& moment, const NavigatorParams& params,
                                      double true_scale) {
  const int quarters = nearest_quarter(moment.T_map_true.yaw - moment.map.T_map_grid().yaw);
  const auto* scaled = dynamic_cast<const ScaleFilter*>(&moment.navigator.localizer());
  std::vector<ExplanationPanel> panels;
  panels.push_back(look_panel(moment, quarters, params.localization.scaled.reach_m));
  if (scaled != nullptr) {
    ScaleFilterParams ranges = params.localization.scaled;
    ranges.field_weight = ranges.free_weight = 0.0;
    ScaleFilterParams field = params.localization.scaled;
    field.range_weight = 0.0;
    panels.push_back(one_look_panel("range_model", "This look alone, by the range model", moment,
                                    params.localization, ranges));
    panels.push_back(one_look_panel("likelihood_field", "This look alone, by the likelihood field",
                                    moment, params.localization, field));
    panels.push_back(one_look_panel("one_look", "This look alone, by both", moment,
                                    params.localization, params.localization.scaled));
  }
  panels.push_back(belief_panel("belief", "Belief, all looks", moment, moment.localization));
  if (scaled != nullptr) {
    panels.push_back(scales_panel(*scaled, true_scale));
  }
  if (params.planning.needs_local_map()) {
    panels.push_back(lattice_panel(moment, params.planning, quarters));
  }
  if (const RepairedMap* repaired = moment.navigator.planner().repaired_map()) {
    panels.push_back(repaired_panel(moment, *repaired));
  }
  return panels;
}

cv::Mat explanation_sheet(const std::vector<ExplanationPanel>& panels, const std::string& title,
                          const std::string& text) {
  constexpr int kColumns = 3;
  constexpr int kTitle = 70;
  const cv::Size cell = panels.front().picture.size();
  const int count = static_cast<int>(panels.size());
  Canvas head{{kColumns * cell.width, kTitle}, kMapColours.paper};
  head.text(title, {kMargin, 30.0}, 13.0, kMapColours.ink, Align::kLeft, true);
  head.text(text, {kMargin, 56.0}, kLetter * 1.1, kMapColours.ink);
  cv::Mat sheet(kTitle + (count + kColumns - 1) / kColumns * cell.height, kColumns * cell.width,
                CV_8UC3, kMapColours.paper);
  head.finished().copyTo(sheet(cv::Rect{0, 0, sheet.cols, kTitle}));
  for (int i = 0; i < count; ++i) {
    panels[static_cast<std::size_t>(i)].picture.copyTo(
        sheet(cv::Rect{{i % kColumns * cell.width, kTitle + i / kColumns * cell.height}, cell}));
  }
  return sheet;
}

}  // namespace cmn
