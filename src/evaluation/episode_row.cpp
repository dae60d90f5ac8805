// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <istream>
#include <iterator>
#include <map>
#include <regex>
#include <stdexcept>
#include <tuple>
#include <type_traits>

namespace cmn {
namespace {

/// Names and members of a row, in the order of the columns; `visit(name, member)`.
template <class Row, class Visitor>
void visit_columns(Row& row, Visitor&& visit) {
  visit("task", row.key.task);
  visit("world", row.key.world);
  visit("mpp", row.key.mpp);
  visit("method", row.key.method);
  visit("index", row.key.index);
  visit("seed", row.key.seed);
  visit("start_x", row.T_world_start.x);
  visit("start_y", row.T_world_start.y);
  visit("start_yaw", row.T_world_start.yaw);
  visit("goal_x", row.goal_world.x);
  visit("goal_y", row.goal_world.y);
  visit("shortest_m", row.shortest_m);
  visit("success", row.is_success);
  visit("success_driven_m", row.success_driven_m);
  visit("success_actions", row.success_actions);
  visit("declared", row.is_declared);
  visit("declared_right", row.is_declared_right);
  visit("actions", row.actions);
  visit("pivots", row.pivots);
  visit("driven_m", row.driven_m);
  visit("simulated_seconds", row.simulated_s);
  visit("converged_actions", row.converged_actions);
  visit("converged_driven_m", row.converged_driven_m);
  visit("falsely_converged", row.is_falsely_converged);
  visit("collisions", row.collisions);
  visit("closest_m", row.closest_m);
  visit("free_iou", row.free_iou);
  visit("obstacle_iou", row.obstacle_iou);
  visit("step_ms", row.step_ms);
  visit("end", row.end);
  visit("drop_actions", row.drop_actions);
  visit("drop_x", row.T_world_drop.x);
  visit("drop_y", row.T_world_drop.y);
  visit("drop_yaw", row.T_world_drop.yaw);
  visit("drop_driven_m", row.drop_driven_m);
  visit("drop_shortest_m", row.drop_shortest_m);
  visit("recovered_actions", row.recovered_actions);
  visit("confidence", row.confidence);
}

std::string text_of(const std::string& value) { return value; }
std::string text_of(const ConfidenceBins& value) { return value.text(); }
std::string text_of(bool value) { return value ? "1" : "0"; }
std::string text_of(int value) { return std::to_string(value); }
std::string text_of(std::uint64_t value) { return std::to_string(value); }
std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void parse(const std::string& text, std::string& value) { value = text; }
void parse(const std::string& text, ConfidenceBins& value) { value = ConfidenceBins::parse(text); }
template <class Number>
void parse(const std::string& text, Number& value) {
  std::size_t used = 0;
  if constexpr (std::is_same_v<Number, double>) {
    value = std::stod(text, &used);
  } else if constexpr (std::is_same_v<Number, std::uint64_t>) {
    value = std::stoull(text, &used);
  } else {
    value = static_cast<Number>(std::stoi(text, &used));
  }
  if (used != text.size()) {
    throw std::invalid_argument(text);
  }
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields{""};
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

auto order_of(const EpisodeKey& key) {
  return std::tie(key.task, key.mpp, key.world, key.index, key.method, key.seed);
}

/// "success 1 or 0, driven_m 3.5 or 4": the columns in which two rows differ; "" for none.
std::string differences(EpisodeRow a, EpisodeRow b) {
  a.step_ms = b.step_ms = 0.0;
  const std::vector<std::string> names = split(csv_header());
  const std::vector<std::string> fields_a = split(csv_line(a));
  const std::vector<std::string> fields_b = split(csv_line(b));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (fields_a[i] != fields_b[i]) {
      text += (text.empty() ? "" : ", ") + names[i] + " " + fields_a[i] + " or " + fields_b[i];
    }
  }
  return text;
}

}  // namespace

std::string EpisodeKey::id() const {
  char number[32];
  std::snprintf(number, sizeof number, "%.2f", mpp);
  return task + "-" + number + "-" + world + "-" + std::to_string(index) + "-" + method;
}

EpisodeKey parse_episode_id(const std::string& id) {
  static const std::regex kPattern{"([^-]+)-([0-9]+\\.[0-9]{2})-(.+)-([0-9]{1,9})-([^-]+)"};
  std::smatch parts;
  if (!std::regex_match(id, parts, kPattern)) {
    throw std::invalid_argument("\"" + id +
                                "\" is not the name of an episode, as CL-0.40-intel-17-ours");
  }
  EpisodeKey key;
  key.task = parts[1];
  key.mpp = std::stod(parts[2]);
  key.world = parts[3];
  key.index = std::stoi(parts[4]);
  key.method = parts[5];
  return key;
}

bool operator<(const EpisodeKey& a, const EpisodeKey& b) { return order_of(a) < order_of(b); }
bool operator==(const EpisodeKey& a, const EpisodeKey& b) { return order_of(a) == order_of(b); }

double EpisodeRow::spl() const {
  if (!is_success) {
    return 0.0;
  }
  const bool is_dropped = drop_actions >= 0;
  const double least_m = is_dropped ? drop_shortest_m : shortest_m;
  return least_m / std::max(least_m, success_driven_m - (is_dropped ? drop_driven_m : 0.0));
}

std::string csv_header() {
  std::string line;
  EpisodeRow row;
  visit_columns(row, [&line](const char* name, const auto& /*value*/) {
    line += line.empty() ? name : std::string{","} + name;
  });
  return line;
}

std::string csv_line(const EpisodeRow& row) {
  std::string line;
  visit_columns(row, [&line](const char* name, const auto& value) {
    line += (line.empty() && std::string{"task"} == name ? "" : ",") + text_of(value);
  });
  return line;
}

std::vector<EpisodeRow> read_episodes(std::istream& in, const std::string& name) {
  const std::string text{std::istreambuf_iterator<char>{in}, std::istreambuf_iterator<char>{}};
  std::vector<EpisodeRow> rows;
  std::size_t number = 0;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    if (++number == 1) {
      if (line != csv_header()) {
        throw std::runtime_error(name + ":1: these are not the columns of episodes.csv");
      }
      continue;
    }
    const std::vector<std::string> fields = split(line);
    EpisodeRow row;
    std::size_t column = 0;
    visit_columns(row, [&](const char* column_name, auto& value) {
      if (column >= fields.size()) {
        throw std::runtime_error(name + ":" + std::to_string(number) + ": too few columns");
      }
      try {
        parse(fields[column++], value);
      } catch (const std::exception&) {
        throw std::runtime_error(name + ":" + std::to_string(number) + ": " + column_name +
                                 " is no number: \"" + fields[column - 1] + "\"");
      }
    });
    if (column != fields.size()) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": too many columns");
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<EpisodeRow> merge_episodes(const std::vector<std::vector<EpisodeRow>>& runs) {
  std::map<std::string, EpisodeRow> by_id;
  constexpr int kMostNamed = 10;
  int conflicts = 0;
  std::string conflict_text;
  for (const std::vector<EpisodeRow>& run : runs) {
    for (const EpisodeRow& row : run) {
      const auto [known, is_new] = by_id.emplace(row.key.id(), row);
      const std::string difference = is_new ? "" : differences(known->second, row);
      if (!difference.empty() && ++conflicts <= kMostNamed) {
        conflict_text += "\n  " + row.key.id() + ": " + difference;
      }
    }
  }
  if (conflicts > 0) {
    throw std::runtime_error(std::to_string(conflicts) +
                             (conflicts == 1 ? " episode" : " episodes") +
                             " came out differently in the runs to be merged; were they "
                             "made with the same options, seed and version?" +
                             conflict_text + (conflicts > kMostNamed ? "\n  ..." : ""));
  }
  std::vector<EpisodeRow> rows;
  for (const auto& [id, row] : by_id) {
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end(),
            [](const EpisodeRow& a, const EpisodeRow& b) { return a.key < b.key; });
  return rows;
}

}  // namespace cmn
