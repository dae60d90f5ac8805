// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/evaluation_report.hpp"

#include "coarse_map_nav/evaluation/ablation.hpp"
#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/evaluation_plots.hpp"
#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/reliability.hpp"
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

const std::array<Plot, 5> kPlots{{
    {"success", "share of episodes at the goal, by actions", success_plot},
    {"bars", "SR and SPL with 95 % intervals",
     [](const std::vector<EpisodeTable>& tables, int) { return bar_plot(tables); }},
    {"buildings", "SPL by building, with 95 % intervals",
     [](const std::vector<EpisodeTable>& tables, int) { return building_plot(tables); }},
    {"convergence", "first convergence of the belief, by actions", convergence_plot},
    {"reliability", "stated confidence against being right",
     [](const std::vector<EpisodeTable>& tables, int) { return reliability_plot(tables); }},
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
  said so and was not. **actions**: mean of an episode. **pivots**: turns of panoramas, which are not
  among them; **seconds**: simulated, that the robot moved for, pivots included.
- **converged**: at some time half the belief lay within 1 m of its estimate; **falsely**: share of those whose estimate
  was then off by more than 1 m or a quarter turn. Actions and metres until then: medians of those that converged.
- **ms / action**: mean wall time of seeing, believing and planning on this machine, whatever else it was doing.
- **IoU**: intersection over union of what the planner was told of the square of 3.2 m about the robot with what a
  sensor without errors would see there from the robot's middle at all its heights, as far as that is in sight.
- **kidnapped**: once the robot was carried elsewhere, and its odometry did not notice; SR, SPL and declarations count
  from then on. **recovered**: the belief had converged to the right place again and stayed, for 5 looks or to the end;
  actions until then: the median of all, those that did not recover counted as later than any.
- **against the whole**: difference to the method with all its parts, on the same episodes, with 95 % intervals
  (Newcombe's for paired shares, bootstrap for SPL).
- **calibration error**: mean over all looks of how far the share that was right lies from the confidence that was
  stated, bin by bin; intervals are bootstraps over episodes.
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
    const EpisodeTable whole = {table.task, table.mpp, without_variants(table.rows)};
    text += text_of("### %s, %.2f m/cell\n\n", table.task.c_str(), table.mpp) +
            success_table(whole) + kidnap_table(table) + cost_table(whole) + sight_table(whole) +
            building_table(whole) + paired_table(whole);
    const std::string ablation = ablation_table(table);
    text +=
        ablation.empty() ? "" : "One part off at a time, in points of a hundred:\n\n" + ablation;
    const std::string reliability = reliability_table(whole);
    text += reliability.empty()
                ? ""
                : "The confidence that was stated, and how often the estimate was right then:\n\n" +
                      reliability;
  }
  return text;
}

/// Episodes that were asked for and could not be.
std::string without_route(const Rows& rows) {
  std::map<std::string, std::string> indices;  // by world, task and resolution
  for (const EpisodeRow& row : merge_episodes({rows})) {
    if (row.end == kNoRoute) {
      std::string& list =
          indices[row.key.world + ", " + row.key.task + text_of(", %.2f m/cell", row.key.mpp)];
      const std::string index = std::to_string(row.key.index);
      const bool is_new =
          list != index && (list.size() <= index.size() ||
                            list.substr(list.size() - index.size() - 1) != " " + index);
      list += !is_new ? "" : (list.empty() ? "" : ", ") + index;
    }
  }
  std::string text;
  for (const auto& [where, list] : indices) {
    text += "- " + where + ": " + list + "\n";
  }
  return text.empty()
             ? ""
             : "**Left out of everything below:** episodes for which no start and goal were "
               "found, by their numbers.\n\n" +
                   text + "\n";
}

}  // namespace

std::vector<std::string> result_lines(const std::vector<EpisodeRow>& rows) {
  std::vector<std::string> lines;
  for (const EpisodeTable& table : episode_tables(played(rows))) {
    for (const std::string& method : methods_of(table.rows)) {
      const Metrics m = metrics_of(of_method(table.rows, method));
      lines.push_back(
          "RESULT task=" + table.task + text_of(" mpp=%.2f", table.mpp) + " method=" + method +
          text_of(" SR=%.3f SPL=%.3f episodes=%d", m.success.value, m.spl.value, m.episodes) +
          (m.mean_pivots > 0.0
               ? text_of(" pivots=%.0f seconds=%.0f", m.mean_pivots, m.mean_simulated_s)
               : "") +
          (m.kidnapped > 0 ? text_of(" recovered=%.3f", m.recovered.value) + " median_actions=" +
                                 number_text("%.0f", m.median_recovered_actions)
                           : ""));
    }
  }
  return lines;
}

std::map<std::string, std::string> report_files(const std::vector<EpisodeRow>& all_rows,
                                                const ReportContext& context) {
  const Rows rows = played(all_rows);
  std::map<std::string, std::string> files;
  std::string text = "# Evaluation\n\n";
  if (context.is_interrupted) {
    text += "**Interrupted: these are not all episodes that were asked for.**\n\n";
  }
  text += context_table(rows, context) + "\n" + without_route(all_rows) + kColumns + "\n";
  for (const std::vector<EpisodeTable>& tables : tables_by_task(rows)) {
    text += task_section(tables);
    const std::string& task = tables.front().task;
    const auto add = [&](const std::string& name, const std::string& caption,
                         const std::string& picture) {
      if (!picture.empty()) {
        const std::string file = name + "_" + task + ".svg";
        files[file] = picture;
        text += "![" + task + ": " + caption + "](" + file + ")\n\n";
      }
    };
    std::vector<EpisodeTable> whole = tables;
    for (EpisodeTable& table : whole) {
      table.rows = without_variants(table.rows);
    }
    for (const Plot& plot : kPlots) {
      add(plot.name, plot.caption, plot.draw(whole, context.horizon));
    }
    add("ablation", "one part off at a time, against the whole", ablation_plot(tables));
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
