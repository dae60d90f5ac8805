// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_report.hpp"

#include "coarse_map_nav/evaluation/localization_error.hpp"
#include "coarse_map_nav/evaluation/run_picture.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace cmn {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;
constexpr std::size_t kFilmFrames = 100;

/// To the millimetre, millisecond and thousandth of a degree.
double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

std::string text_of(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

std::string ending_of(const RunOutcome& outcome) {
  if (!outcome.is_reached()) {
    return outcome.state == "STOPPED" ? "stopped" : "gave up";
  }
  const double off_m = outcome.true_distance_m().value_or(0.0);
  return off_m <= kRightWithin_m ? "reached"
                                 : "thinks it is there, " + text_of(off_m, 1) + " m off";
}

std::string subtitle_of(const RunRecord& record, const RunOutcome& outcome) {
  std::string text = std::to_string(outcome.actions) + " actions, " +
                     text_of(record.driven_m(), 1) + " m driven in " +
                     text_of(record.duration_s(), 0) + " s";
  if (const auto distance = outcome.true_distance_m()) {
    text += "; ended " + text_of(*distance, 2) + " m from the goal";
  }
  text += "; " + outcome.robot + ", preset " + outcome.preset + ", seed " +
          std::to_string(outcome.seed);
  return outcome.is_reached() ? text : text + "; " + outcome.reason;
}

}  // namespace

std::optional<double> RunOutcome::true_distance_m() const {
  return T_world_end && goal.world
             ? std::optional<double>{norm(T_world_end->position() - *goal.world)}
             : std::nullopt;
}

std::string summary_json(const RunRecord& record, const RunOutcome& outcome) {
  Json start = nullptr;
  if (!record.track().empty()) {
    const Pose2& pose = record.track().front().T_world_robot;
    start = {{"x", rounded(pose.x)},
             {"y", rounded(pose.y)},
             {"yaw_deg", rounded(pose.yaw * 180.0 / kPi)}};
  }
  const std::optional<double> distance = outcome.true_distance_m();
  const auto& moments = record.moments();
  const Json summary{
      {"reached", outcome.is_reached()},
      {"state", outcome.state},
      {"reason", outcome.reason},
      {"world", outcome.world},
      {"map", outcome.map},
      {"goal",
       {{"name", outcome.goal.name},
        {"x", rounded(outcome.goal.map.x)},
        {"y", rounded(outcome.goal.map.y)}}},
      {"robot", outcome.robot},
      {"preset", outcome.preset},
      {"seed", outcome.seed},
      {"start", start},
      {"actions", outcome.actions},
      {"collisions", outcome.collisions},
      {"sim_time_s", rounded(record.duration_s())},
      {"wall_time_s", rounded(outcome.wall_time_s)},
      {"driven_m", rounded(record.driven_m())},
      {"true_distance_to_goal_m", distance ? Json(rounded(*distance)) : Json(nullptr)},
      {"localized", !moments.empty() && moments.back().converged}};
  constexpr auto kReplaceBadUtf8 = Json::error_handler_t::replace;
  return summary.dump(2, ' ', false, kReplaceBadUtf8) + "\n";
}

void write_run_report(const std::string& folder, const RunSetting& setting, const RunRecord& record,
                      const RunOutcome& outcome) {
  const fs::path out{folder};
  fs::create_directories(out);
  if (!record.moments().empty()) {
    const std::string title = fs::path{outcome.world}.stem().string() + ", to " + outcome.goal.name;
    const std::string ending = ending_of(outcome);
    const std::string picture = (out / "run.png").string();
    if (!cv::imwrite(picture, run_picture(setting, record, title + ": " + ending,
                                          subtitle_of(record, outcome)))) {
      throw std::runtime_error(picture + ": cannot be written");
    }
    write_gif((out / "run.gif").string(), run_film(setting, record, title, ending, kFilmFrames));
  }
  const fs::path draft = out / "summary.json.part";
  std::ofstream file{draft};
  file << summary_json(record, outcome);
  file.close();
  if (!file) {
    throw std::runtime_error(draft.string() + ": cannot be written; is the disk full?");
  }
  fs::rename(draft, out / "summary.json");
}

}  // namespace cmn
