// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_gallery.hpp"

#include "coarse_map_nav/evaluation/canvas.hpp"
#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/map_view.hpp"
#include "coarse_map_nav/evaluation/table_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <tuple>

namespace cmn {
namespace {

using Steps = std::vector<TraceStep>;

constexpr std::size_t kLately = 100;  ///< actions
constexpr double kSpot_m = 1.5;       ///< who stays within does not get on
constexpr double kLeap_m = 0.5;       ///< no action takes the robot so far: it was carried
constexpr double kMisledShare = 0.2;

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

bool is_misled(const TraceStep& step) { return step.is_converged && !step.is_right(); }

/// From which step on all have been so, to the last.
template <class Condition>
std::size_t since_when(const Steps& steps, Condition&& is_so) {
  const auto last_other = std::find_if_not(steps.rbegin(), steps.rend(), is_so);
  return static_cast<std::size_t>(steps.rend() - last_other);
}

/// How far from their middle the places of some steps lie at most.
double reach_m(Steps::const_iterator begin, Steps::const_iterator end) {
  Point2 low = begin->T_world_robot.position();
  Point2 high = low;
  for (auto step = begin; step != end; ++step) {
    const Point2 p = step->T_world_robot.position();
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return 0.5 * norm(high - low);
}

/// Driven before a step.
double driven_until_m(const Steps& steps, std::size_t end) {
  double driven_m = 0.0;
  for (std::size_t i = 1; i <= end && i < steps.size(); ++i) {
    const double leap_m =
        norm(steps[i].T_world_robot.position() - steps[i - 1].T_world_robot.position());
    driven_m += leap_m < kLeap_m ? leap_m : 0.0;
  }
  return driven_m;
}

/// Where what is judged begins: where the robot was put down, otherwise at the start.
Steps::const_iterator start_of(const EpisodeTrace& trace, Steps::const_iterator end) {
  if (trace.row.drop_actions >= 0) {
    const auto leap =
        std::adjacent_find(trace.steps.begin(), end, [](const TraceStep& a, const TraceStep& b) {
          return norm(b.T_world_robot.position() - a.T_world_robot.position()) > kLeap_m;
        });
    if (leap != end) {
      return leap + 1;
    }
  }
  return trace.steps.begin();
}

EpisodeCause cause_of_failure(const EpisodeTrace& trace) {
  const EpisodeRow& row = trace.row;
  const Steps& steps = trace.steps;
  const TraceStep& last = steps.back();
  if (row.drop_actions >= 0 && row.recovered_actions < 0) {
    return {"did not recover",
            text_of("carried off after action %d; then never right for good", row.drop_actions) +
                (row.is_declared ? text_of("; said REACHED after action %d", row.actions) : "")};
  }
  if (row.converged_actions < 0) {
    return {"never converged",
            text_of("in %d actions and %.0f m, confidence %.2f at most", row.actions, row.driven_m,
                    std::max_element(steps.begin(), steps.end(),
                                     [](const TraceStep& a, const TraceStep& b) {
                                       return a.confidence < b.confidence;
                                     })
                        ->confidence)};
  }
  if (row.is_declared && !row.is_declared_right) {
    return {
        "declared elsewhere",
        text_of("said REACHED after action %d, %.1f m from the goal; the estimate was off by "
                "%.1f m",
                row.actions, norm(last.T_world_robot.position() - row.goal_world), last.off_m())};
  }
  if (is_misled(last)) {
    return {"converged falsely", text_of("sure of a wrong place from action %zu to the end, off "
                                         "by %.1f m",
                                         since_when(steps, is_misled), last.off_m())};
  }
  if (!last.is_converged) {
    return {"lost its place",
            text_of("converged after action %d, not sure from action %zu to the end",
                    row.converged_actions,
                    since_when(steps, [](const TraceStep& s) { return !s.is_converged; }))};
  }
  const std::size_t lately = std::min(kLately, steps.size());
  const auto begin = steps.end() - static_cast<std::ptrdiff_t>(lately);
  const double spot_m = reach_m(begin, steps.end());
  if (steps.size() >= kLately && spot_m < kSpot_m) {
    return {"knew its place, did not get on",
            text_of("within %.1f m for the last %zu actions, %d collisions; never nearer than "
                    "%.1f m",
                    spot_m, lately, last.collisions - begin->collisions, row.closest_m)};
  }
  return {
      "knew its place, ran out of actions",
      text_of("sure and right from action %zu on; never nearer than %.1f m",
              since_when(steps, [](const TraceStep& s) { return s.is_converged && s.is_right(); }),
              row.closest_m)};
}

EpisodeCause cause_of_detour(const EpisodeTrace& trace) {
  const EpisodeRow& row = trace.row;
  const auto end = std::min(trace.steps.size(), static_cast<std::size_t>(row.success_actions) + 1);
  const auto until = trace.steps.begin() + static_cast<std::ptrdiff_t>(end);
  const Steps steps{start_of(trace, until), until};
  const auto misled = std::count_if(steps.begin(), steps.end(), is_misled);
  if (static_cast<double>(misled) > kMisledShare * static_cast<double>(steps.size())) {
    return {"misled on the way",
            text_of("sure of a wrong place at %td of %zu looks", misled, steps.size())};
  }
  const auto knew = static_cast<std::size_t>(
      std::find_if(steps.begin(), steps.end(),
                   [](const TraceStep& s) { return s.is_converged && s.is_right(); }) -
      steps.begin());
  const double before_m = driven_until_m(steps, knew);
  const bool is_carried = row.drop_actions >= 0;
  const double excess_m = is_carried
                              ? row.success_driven_m - row.drop_driven_m - row.drop_shortest_m
                              : row.success_driven_m - row.shortest_m;
  if (knew > 0 && before_m > 0.5 * excess_m) {
    return {"knew its place late", knew == steps.size()
                                       ? text_of("not before the goal, after %.1f m", before_m)
                                       : text_of("after action %zu and %.1f m", knew, before_m)};
  }
  return {"detour", text_of("of %.1f m, most of it when it knew its place", excess_m)};
}

}  // namespace

EpisodeCause cause_of(const EpisodeTrace& trace) {
  if (trace.steps.empty()) {
    return {trace.row.end, "before the first action"};
  }
  return trace.row.is_success ? cause_of_detour(trace) : cause_of_failure(trace);
}

std::vector<EpisodeRow> worst_episodes(const std::vector<EpisodeRow>& rows, std::size_t count) {
  std::vector<EpisodeRow> sorted = played(rows);
  const auto badness = [](const EpisodeRow& row) {
    return std::tuple{row.is_success, row.is_success ? 0.0 : -row.closest_m, row.spl()};
  };
  std::sort(sorted.begin(), sorted.end(), [&](const EpisodeRow& a, const EpisodeRow& b) {
    return badness(a) != badness(b) ? badness(a) < badness(b) : a.key < b.key;
  });
  sorted.resize(std::min(sorted.size(), count), EpisodeRow{});
  return sorted;
}

std::string gallery_table(const std::vector<EpisodeTrace>& traces) {
  std::string text =
      table_head({"episode", "cause", "in detail", "SPL", "closest [m]", "actions", "converged at",
                  "sure and right [%]", "sure and wrong [%]", "collisions", "end"});
  for (const EpisodeTrace& trace : traces) {
    const EpisodeRow& row = trace.row;
    const EpisodeCause cause = cause_of(trace);
    const auto share = [&](auto&& condition) {
      const auto n = std::count_if(trace.steps.begin(), trace.steps.end(), condition);
      return trace.steps.empty() ? EpisodeRow::kNever
                                 : static_cast<double>(n) / static_cast<double>(trace.steps.size());
    };
    const std::string id = row.key.id();
    text += table_row(
        {trace.steps.empty() ? id : "[" + id + "](" + file_name_of(row.key) + ".png)", cause.kind,
         cause.detail, number_text("%.2f", row.spl()), number_text("%.1f", row.closest_m),
         std::to_string(row.actions),
         row.converged_actions < 0 ? kNoNumber : std::to_string(row.converged_actions),
         percent_text(share([](const TraceStep& s) { return s.is_converged && s.is_right(); })),
         percent_text(share(is_misled)), std::to_string(row.collisions), row.end});
  }
  return text + "\n";
}

cv::Mat gallery_sheet(const std::vector<EpisodeTrace>& traces) {
  constexpr double kWidth = 760.0;
  constexpr double kMargin = 20.0;
  constexpr double kCaption = 34.0;
  struct Entry {
    cv::Mat picture;
    std::string caption;
    double height;
  };
  std::vector<Entry> entries;
  for (const EpisodeTrace& trace : traces) {
    if (!trace.steps.empty()) {
      const cv::Mat picture = trace_picture(trace);
      const EpisodeCause cause = cause_of(trace);
      entries.push_back(
          {picture, std::to_string(entries.size() + 1) + ". " + cause.kind + ": " + cause.detail,
           kWidth * picture.rows / picture.cols});
    }
  }
  if (entries.empty()) {
    throw std::invalid_argument("there is no episode to draw");
  }
  const auto row_height = [&](std::size_t i) {
    return kCaption +
           std::max(entries[i].height, i + 1 < entries.size() ? entries[i + 1].height : 0.0);
  };
  double height = kMargin;
  for (std::size_t i = 0; i < entries.size(); i += 2) {
    height += row_height(i) + kMargin;
  }
  const double width = (entries.size() > 1 ? 2.0 : 1.0) * (kWidth + kMargin) + kMargin;
  Canvas canvas{{cvRound(width), cvRound(height)}, kMapColours.white};
  double top = kMargin;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double left = kMargin + (i % 2 == 0 ? 0.0 : kWidth + kMargin);
    const double letter =
        std::min(11.0, 11.0 * kWidth / Canvas::text_width(entries[i].caption, 11.0, true));
    canvas.text(entries[i].caption, {left, top + 20.0}, letter, kMapColours.ink, Align::kLeft,
                true);
    canvas.picture(entries[i].picture, {left, top + kCaption, kWidth, entries[i].height});
    canvas.frame({left, top + kCaption, kWidth, entries[i].height}, kMapColours.faint_ink, 0.5);
    if (i % 2 == 1) {
      top += row_height(i - 1) + kMargin;
    }
  }
  return canvas.finished();
}

std::string file_name_of(const EpisodeKey& key) {
  std::string name = key.id();
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
}

}  // namespace cmn
