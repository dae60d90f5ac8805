// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How judged episodes were made; kept beside them as run.yaml.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

struct ReportContext {
  std::string command;  ///< the line that makes the episodes again
  std::string machine;  ///< empty: not known
  std::string version;  ///< of the package; empty: not known
  std::uint64_t seed = 0;
  double robot_radius_m = 0.18;
  double success_radius_m = 0.4;
  int horizon = 500;            ///< [actions] at most
  double wall_time_s = 0.0;     ///< of the run; 0: not known
  bool is_interrupted = false;  ///< these are not all episodes that were asked for
  std::vector<std::pair<std::string, std::string>> settings;  ///< whatever else, name and value
};

/// Throws std::runtime_error naming the file that cannot be written, or read and why.
void write_context(const ReportContext& context, const std::string& path);
ReportContext read_context(const std::string& path);

/// Whether their episodes belong into one table: seed, radii, horizon, version and the values of
/// settings that both have are the same.
bool are_alike(const ReportContext& a, const ReportContext& b);

/// Of several runs to be merged: what they have in common, each run's command, machine and time
/// among the settings. Throws std::runtime_error when they are not alike. `runs` must not be empty.
ReportContext merge_contexts(const std::vector<ReportContext>& runs);

}  // namespace cmn
