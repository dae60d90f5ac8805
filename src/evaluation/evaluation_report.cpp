// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/evaluation_report.hpp"

#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/evaluation_plots.hpp"
#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/report_tables.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

namespace cmn {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<EpisodeRow>;

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string context_table(const Rows& rows, const ReportContext& context) {
  std::set<std::string> worlds;
  for (const EpisodeRow& row : rows) {
    worlds.insert(row.key.world);
  }
  std::string text = "| | |\n|---|---|\n";
  const auto add = [&text](const std::string& name, const std::string& value) {
    text += value.empty() ? "" : table_row({name, value});
  };
  add("command", context.command.empty() ? "" : "`" + context.command + "`");
  add("version", context.version);
  add("machine", context.machine);
  add("episodes", text_of("%zu, in %zu worlds", rows.size(), worlds.size()));
  add("seed", std::to_string(context.seed));
  add("an episode", text_of("at most %d actions; success: within %.2f m of the goal; robot of "
                            "radius %.2f m",
                            context.horizon, context.success_radius_m, context.robot_radius_m));
  add("took", context.wall_time_s > 0.0 ? text_of("%.0f s", context.wall_time_s) : "");
  for (const auto& [name, value] : context.settings) {
    add(name, value);
  }
  return text;
}

/// A plot, the file it goes to, and what the report calls it.
struct Plot {
  std::string name;
  std::string caption;
  std::string (*draw)(const std::vector<EpisodeTable>&, int horizon);
};

const std::array<Plot, 4> kPlots{{
    {"success", "share of episodes at the goal, by actions", success_plot},
    {"bars", "SR and SPL with 95 % intervals",
     [](const std::vector<EpisodeTable>& tables, int) { return bar_plot(tables); }},
    {"buildings", "SPL by building, with 95 % intervals",
     [](const std::vector<EpisodeTable>& tables, int) { return building_plot(tables); }},
    {"convergence", "first convergence of the belief, by actions", convergence_plot},
}};

/// The tables of each task, in their order.
std::vector<std::vector<EpisodeTable>> tables_by_task(const Rows& rows) {
  std::vector<std::vector<EpisodeTable>> tasks;
  for (EpisodeTable& table : episode_tables(rows)) {
    if (tasks.empty() || tasks.back().front().task != table.task) {
      tasks.emplace_back();
    }
    tasks.back().push_back(std::move(table));
  }
  return tasks;
}

constexpr const char* kColumns =
    R"(- **SR**: share of episodes that came within the success radius of the goal. **SPL**: the same, each weighted by the
  shortest way over the way driven (at most 1). In brackets 95 % intervals, Wilson's for shares, bootstrap for SPL: over
  episodes in these worlds, not over worlds.
- **declared SR**: the robot itself said that it had arrived, and was within 1 m of the goal; **declared elsewhere**: it
  said so and was not. **actions**: mean of an episode.
- **converged**: at some time half the belief lay within 1 m of its estimate; **falsely**: share of those whose estimate
  was then off by more than 1 m or a quarter turn. Actions and metres until then: medians of those that converged.
- **ms / action**: mean wall time of seeing, believing and planning on this machine, whatever else it was doing.
- A dash: there is no such number.
)";

std::string task_section(const std::vector<EpisodeTable>& tables) {
  std::string text = "## " + task_title(tables.front().task) + "\n\n";
  const std::string paper = paper_table(tables);
  if (!paper.empty()) {
    text +=
        "### Beside the paper\n\nThe figures of the CMN paper are of Gibson houses, other "
        "environments than these.\n\n" +
        paper;
  }
  for (const EpisodeTable& table : tables) {
    text += text_of("### %s, %.2f m/cell\n\n", table.task.c_str(), table.mpp) +
            success_table(table) + cost_table(table) + building_table(table) + paired_table(table);
  }
  return text;
}

}  // namespace

std::vector<std::string> result_lines(const std::vector<EpisodeRow>& rows) {
  std::vector<std::string> lines;
  for (const EpisodeTable& table : episode_tables(rows)) {
    for (const std::string& method : methods_of(table.rows)) {
      const Metrics m = metrics_of(of_method(table.rows, method));
      lines.push_back(
          "RESULT task=" + table.task + text_of(" mpp=%.2f", table.mpp) + " method=" + method +
          text_of(" SR=%.3f SPL=%.3f episodes=%d", m.success.value, m.spl.value, m.episodes));
    }
  }
  return lines;
}

std::map<std::string, std::string> report_files(const std::vector<EpisodeRow>& rows,
                                                const ReportContext& context) {
  std::map<std::string, std::string> files;
  std::string text = "# Evaluation\n\n";
  if (context.is_interrupted) {
    text += "**Interrupted: these are not all episodes that were asked for.**\n\n";
  }
  text += context_table(rows, context) + "\n" + kColumns + "\n";
  for (const std::vector<EpisodeTable>& tables : tables_by_task(rows)) {
    text += task_section(tables);
    for (const Plot& plot : kPlots) {
      const std::string name = plot.name + "_" + tables.front().task + ".svg";
      const std::string picture = plot.draw(tables, context.horizon);
      if (!picture.empty()) {
        files[name] = picture;
        text += "![" + tables.front().task + ": " + plot.caption + "](" + name + ")\n\n";
      }
    }
  }
  files["report.md"] = text;
  return files;
}

void write_report(const std::vector<EpisodeRow>& rows, const ReportContext& context,
                  const std::string& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) {
    throw std::runtime_error(folder + ": cannot be made: " + fault.message());
  }
  for (const auto& [name, content] : report_files(rows, context)) {
    const fs::path path = fs::path{folder} / name;
    std::ofstream file{path, std::ios::binary};
    file << content;
    file.close();
    if (!file) {
      throw std::runtime_error(path.string() + ": cannot be written");
    }
  }
}

}  // namespace cmn
