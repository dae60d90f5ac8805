// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "replay.hpp"

#include "coarse_map_nav/evaluation/episode_gallery.hpp"
#include "coarse_map_nav/evaluation/explanation.hpp"
#include "coarse_map_nav/evaluation/gif.hpp"
#include "coarse_map_nav/evaluation/run_picture.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

namespace cmn {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFilmFrames = 120;

/// Of the episode that is replayed.
using MomentPainter = std::function<void(const EpisodeMoment& moment, int action)>;

EpisodeRecorder recorder_of(Recording& recording, const MomentPainter& paint) {
  return [&recording, &paint](const EpisodeMoment& moment) {
    paint(moment, static_cast<int>(recording.trace.steps.size()));
    const Localization& at = moment.localization;
    const auto action = static_cast<double>(recording.trace.steps.size());
    recording.trace.steps.push_back(
        {moment.T_world_robot, moment.T_world_estimate, at.confidence, entropy(at.belief),
         moment.collisions,
         at.is_converged && at.confidence >= recording.trace.converged_confidence});
    recording.setting.map = moment.map;
    recording.setting.goal_map = moment.goal_map;
    const Grid<double> cells = marginal(at.belief);
    RunMoment shown;
    shown.time_s = action;
    shown.marginal = Grid<float>{cells.width(), cells.height()};
    std::copy(cells.values().begin(), cells.values().end(), shown.marginal.values().begin());
    shown.T_map_estimate = moment.T_map_estimate;
    shown.confidence = at.confidence;
    shown.converged = at.is_converged;
    shown.T_world_robot = moment.T_world_robot;
    shown.T_map_robot = moment.T_map_true;
    recording.record.add(std::move(shown));
    recording.record.add(TrackPoint{action, moment.T_world_robot});
  };
}

/// What an earlier run has to say about the same episode.
void compare(const Plan& plan, const EpisodeRow& row) {
  if (!fs::exists(plan.out / "episodes.csv")) {
    return;
  }
  for (const EpisodeRow& earlier : rows_in(plan.out)) {
    if (earlier.key.id() == row.key.id()) {
      merge_episodes({{earlier}, {row}});
      std::cout << "the same as in episodes.csv\n";
    }
  }
}

std::string world_of(const Plan& plan, const EpisodeKey& key) {
  for (const std::string& world : plan.worlds) {
    if (scene_name(world) == key.world) {
      return world;
    }
  }
  throw std::runtime_error(key.id() + " needs a --world that is called " + key.world);
}

}  // namespace

std::vector<EpisodeRow> rows_in(const fs::path& folder) {
  const std::string path = (folder / "episodes.csv").string();
  std::ifstream in{path};
  if (!in) {
    throw std::runtime_error(path + ": cannot be read");
  }
  return read_episodes(in, path);
}

void write_picture(const fs::path& path, const cv::Mat& picture) {
  if (!cv::imwrite(path.string(), picture)) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
  std::cout << path.string() << "\n";
}

namespace {

/// Writes the sheet and the panels of a moment.
void write_explanation(const fs::path& path, const EpisodeMoment& moment,
                       const NavigatorParams& params, double true_scale, const std::string& title) {
  const std::vector<ExplanationPanel> panels = explain(moment, params, true_scale);
  write_picture(path.string() + ".png", explanation_sheet(panels, title, moment.decision.text));
  fs::create_directories(path);
  for (const ExplanationPanel& panel : panels) {
    write_picture(path / (panel.name + ".png"), panel.picture);
  }
}

}  // namespace

Recording run_again(const Plan& plan, Worlds& worlds, EpisodeKey key,
                    const std::vector<int>& explained) {
  const Task& task = find_task(key.task);
  const auto method = std::find_if(plan.methods.begin(), plan.methods.end(),
                                   [&](const Method& m) { return m.name == key.method; });
  const NavigatorParams params = method_params(*method, task, plan.config.string());
  const std::string world = world_of(plan, key);
  const Scene& scene = worlds.open(world, has_heights(world, params));
  const std::optional<Stage> ready = stage(scene, task, key.mpp, plan.judge, key.seed);
  if (!ready) {
    throw std::runtime_error(key.id() + ": no start and goal are far enough apart");
  }
  key.seed = ready->seed;
  Recording recording;
  recording.trace.world = recording.setting.world.emplace(scene.map);
  recording.trace.success_radius_m = plan.judge.success_radius_m;
  recording.trace.converged_confidence = plan.judge.converged_confidence;
  recording.setting.goal_world = ready->route.goal_world;
  recording.setting.time_unit = "actions";
  const MomentPainter paint = [&](const EpisodeMoment& moment, int action) {
    if (std::find(explained.begin(), explained.end(), action) != explained.end()) {
      const std::string number = std::to_string(action);
      write_explanation(plan.out / (file_name_of(key) + "_action_" + number), moment, params,
                        ready->drawing.scale(), key.id() + ", before action " + number);
    }
  };
  recording.trace.row =
      run_judged_episode(scene, task, ready->drawing, ready->route, *method, params, plan.judge,
                         key, seconds, recorder_of(recording, paint), predictor_for(plan, params));
  for (const int action : explained) {
    if (action >= static_cast<int>(recording.trace.steps.size())) {
      std::cout << key.id() << " ended before action " << action << "\n";
    }
  }
  return recording;
}

void replay(const Plan& plan, const std::vector<std::string>& ids,
            const std::vector<int>& explained) {
  fs::create_directories(plan.out);
  Worlds worlds{plan};
  std::map<std::string, std::vector<EpisodeTrace>> traces;  // by the name of the file
  for (const std::string& id : ids) {
    EpisodeKey key = parse_episode_id(id);
    key.seed = episode_seed(plan.seed, key.world, key.index);
    const Recording recording = run_again(plan, worlds, key, explained);
    std::cout << csv_header() << "\n" << csv_line(recording.trace.row) << "\n";
    if (recording.trace.steps.empty()) {
      std::cout << id << " ended before its first step: " << recording.trace.row.end << "\n";
      continue;
    }
    write_picture(plan.out / (file_name_of(key) + ".png"), trace_picture(recording.trace));
    const fs::path film = plan.out / (file_name_of(key) + ".gif");
    write_gif(film.string(), run_film(recording.setting, recording.record, id,
                                      recording.trace.row.end, kFilmFrames));
    std::cout << film.string() << "\n";
    compare(plan, recording.trace.row);
    const std::string file = file_name_of(key);
    traces[file.substr(0, file.rfind('-'))].push_back(recording.trace);
  }
  for (const auto& [name, group] : traces) {
    if (group.size() > 1) {
      write_picture(plan.out / (name + ".png"), trace_comparison(group));
    }
  }
}

}  // namespace cmn
