// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/report_tables.hpp"

#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/paper_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <set>

namespace cmn {
namespace {

using Rows = std::vector<EpisodeRow>;

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// "81.0 / 64.2": SR and SPL in per cent, as the papers print them.
std::string success_and_spl(const Rows& rows) {
  const Metrics metrics = metrics_of(rows);
  return rows.empty()
             ? kNoNumber
             : percent_text(metrics.success.value) + " / " + percent_text(metrics.spl.value);
}

/// Methods that lack episodes which others have run: their rows cannot be laid side by side.
std::string unequal_methods(const EpisodeTable& table) {
  std::map<std::string, std::size_t> counts;
  std::size_t most = 0;
  for (const EpisodeRow& row : table.rows) {
    most = std::max(most, ++counts[row.key.method]);
  }
  std::string names;
  for (const std::string& method : methods_of(table.rows)) {
    if (counts[method] < most) {
      names += (names.empty() ? "" : ", ") + method_label(method) +
               text_of(" (%zu of %zu)", counts[method], most);
    }
  }
  return names.empty() ? "" : "**Not on the same episodes:** " + names + ".\n\n";
}

}  // namespace

std::string success_table(const EpisodeTable& table) {
  std::string text = unequal_methods(table) +
                     table_head({"method", "N", "SR [%]", "SPL [%]", "declared SR [%]",
                                 "declared elsewhere [%]", "actions", "pivots", "seconds"});
  for (const std::string& method : methods_of(table.rows)) {
    const Metrics m = metrics_of(of_method(table.rows, method));
    text +=
        table_row({method_label(method), std::to_string(m.episodes), interval_text(m.success),
                   interval_text(m.spl), percent_text(m.declared_right.value),
                   percent_text(m.declared_wrong.value), number_text("%.0f", m.mean_actions),
                   number_text("%.0f", m.mean_pivots), number_text("%.0f", m.mean_simulated_s)});
  }
  return text + "\n";
}

std::string cost_table(const EpisodeTable& table) {
  std::string text = table_head({"method", "converged [%]", "falsely [%]", "actions to converge",
                                 "metres to converge", "collisions / 100 m", "ms / action"});
  for (const std::string& method : methods_of(table.rows)) {
    const Metrics m = metrics_of(of_method(table.rows, method));
    text += table_row(
        {method_label(method), percent_text(m.converged.value), interval_text(m.falsely_converged),
         number_text("%.0f", m.median_converged_actions),
         number_text("%.1f", m.median_converged_driven_m),
         number_text("%.1f", m.collisions_per_100_m), number_text("%.2f", m.step_ms)});
  }
  return text + "\n";
}

std::string building_table(const EpisodeTable& table) {
  const std::vector<std::string> buildings = buildings_of(table.rows);
  if (buildings.size() < 2) {
    return "All in one building: " + buildings.front() + ".\n\n";
  }
  std::vector<std::string> head{"SR / SPL [%]"};
  for (const std::string& building : buildings) {
    std::size_t most = 0;
    for (const std::string& method : methods_of(table.rows)) {
      most = std::max(most, of_method(of_building(table.rows, building), method).size());
    }
    head.push_back(building + text_of(" (%zu)", most));
  }
  head.emplace_back("all");
  std::string text = table_head(head);
  for (const std::string& method : methods_of(table.rows)) {
    const Rows rows = of_method(table.rows, method);
    std::vector<std::string> cells{method_label(method)};
    for (const std::string& building : buildings) {
      cells.push_back(success_and_spl(of_building(rows, building)));
    }
    cells.push_back(success_and_spl(rows));
    text += table_row(cells);
  }
  return text + "\n";
}

std::string kidnap_table(const EpisodeTable& table) {
  std::string text =
      table_head({"kidnapped", "N", "recovered [%]", "actions after the drop, median",
                  "at the goal then [%]", "declared elsewhere [%]"});
  bool has_any = false;
  for (const std::string& method : methods_of(table.rows)) {
    const Metrics m = metrics_of(of_method(table.rows, method));
    has_any = has_any || m.kidnapped > 0;
    text += table_row({method_label(method), std::to_string(m.kidnapped),
                       interval_text(m.recovered), number_text("%.0f", m.median_recovered_actions),
                       percent_text(m.success.value), percent_text(m.declared_wrong.value)});
  }
  return has_any ? text + "\n" : "";
}

std::string sight_table(const EpisodeTable& table) {
  std::string text = table_head({"seen", "IoU of free ground [%]", "IoU of obstacles [%]"});
  bool has_any = false;
  for (const std::string& method : methods_of(table.rows)) {
    const Metrics m = metrics_of(of_method(table.rows, method));
    has_any = has_any || !std::isnan(m.free_iou);
    text +=
        table_row({method_label(method), percent_text(m.free_iou), percent_text(m.obstacle_iou)});
  }
  return has_any ? text + "\n" : "";
}

std::string paired_table(const EpisodeTable& table) {
  const std::vector<std::string> methods = methods_of(table.rows);
  if (methods.size() < 2) {
    return "";
  }
  const std::string first = method_label(methods.front());
  std::string text = table_head({first + " against", "episodes", "only " + first + " succeeds",
                                 "only the other", "sign test p"});
  const Rows first_rows = of_method(table.rows, methods.front());
  for (std::size_t i = 1; i < methods.size(); ++i) {
    const PairedSuccess pairs = paired_success(first_rows, of_method(table.rows, methods[i]));
    text += table_row({method_label(methods[i]), std::to_string(pairs.episodes),
                       std::to_string(pairs.only_first), std::to_string(pairs.only_second),
                       pairs.p_value < 1e-4 ? "< 0.0001" : text_of("%.4f", pairs.p_value)});
  }
  return text + "\n";
}

std::string paper_table(const std::vector<EpisodeTable>& tables) {
  const std::string& task = tables.front().task;
  const std::vector<PaperFigure> figures = paper_figures(task);
  if (figures.empty()) {
    return "";
  }
  // Only what the paper also has, in its order of merit, after our own method.
  std::vector<std::string> methods{"ours"};
  for (const PaperFigure& figure : figures) {
    methods.push_back(figure.method);
  }
  std::vector<std::string> head{"SR / SPL [%]"};
  for (const double mpp : kPaperMpps) {
    head.push_back(text_of("paper, %.1f m/cell", mpp));
    head.emplace_back("here");
  }
  std::string text = table_head(head);
  for (const std::string& method : methods) {
    const auto figure = std::find_if(figures.begin(), figures.end(),
                                     [&](const PaperFigure& f) { return f.method == method; });
    std::vector<std::string> cells{method_label(method)};
    for (std::size_t i = 0; i < kPaperMpps.size(); ++i) {
      cells.push_back(figure == figures.end()
                          ? kNoNumber
                          : text_of("%.1f / %.1f", figure->at_mpps[i].success_percent,
                                    figure->at_mpps[i].spl_percent));
      const auto table = std::find_if(tables.begin(), tables.end(), [&](const EpisodeTable& t) {
        return std::abs(t.mpp - kPaperMpps[i]) < 1e-6;
      });
      cells.push_back(table == tables.end() ? kNoNumber
                                            : success_and_spl(of_method(table->rows, method)));
    }
    text += table_row(cells);
  }
  return text + "\n";
}

}  // namespace cmn
