// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "gallery.hpp"

#include "coarse_map_nav/evaluation/episode_gallery.hpp"
#include "coarse_map_nav/evaluation/episode_group.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "replay.hpp"

namespace cmn {
namespace {

namespace fs = std::filesystem;

std::vector<EpisodeRow> rows_of(const Plan& plan, const std::string& method,
                                const std::vector<EpisodeRow>& all) {
  std::vector<EpisodeRow> rows;
  for (const EpisodeRow& row : all) {
    const bool is_asked_for = std::count(plan.tasks.begin(), plan.tasks.end(), row.key.task) > 0 &&
                              std::any_of(plan.mpps.begin(), plan.mpps.end(), [&](double mpp) {
                                return std::abs(mpp - row.key.mpp) < 1e-6;
                              });
    if (row.key.method == method && is_asked_for) {
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

void leave_gallery(const Plan& plan, std::size_t count) {
  const std::vector<EpisodeRow> all = rows_in(plan.out);
  const fs::path folder = plan.out / "gallery";
  fs::create_directories(folder);
  Worlds worlds{plan};
  std::string text = "# The worst episodes\n\nWhat the columns say: docs/evaluation.md.\n\n";
  for (const Method& method : plan.methods) {
    const std::vector<EpisodeRow> rows = rows_of(plan, method.name, all);
    if (rows.empty()) {
      throw std::runtime_error((plan.out / "episodes.csv").string() + " has no episode of " +
                               method.name + " on these tasks");
    }
    std::vector<EpisodeTrace> traces;
    for (const EpisodeRow& row : worst_episodes(rows, count)) {
      EpisodeKey key = row.key;
      key.seed = episode_seed(plan.seed, key.world, key.index);
      traces.push_back(run_again(plan, worlds, key).trace);
      merge_episodes({{row}, {traces.back().row}});
      if (!traces.back().steps.empty()) {
        write_picture(folder / (file_name_of(key) + ".png"), trace_picture(traces.back()));
      }
    }
    text += "## " + method_label(method.name) + "\n\n" + gallery_table(traces);
    const bool is_seen = std::any_of(traces.begin(), traces.end(), [](const EpisodeTrace& trace) {
      return !trace.steps.empty();
    });
    if (is_seen) {
      write_picture(folder / (method.name + ".png"), gallery_sheet(traces));
      text +=
          "![the worst episodes of " + method_label(method.name) + "](" + method.name + ".png)\n\n";
    }
  }
  const fs::path file = folder / "gallery.md";
  std::ofstream out{file};
  out << text;
  out.close();
  if (!out) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  std::cout << file.string() << "\n";
}

}  // namespace cmn
