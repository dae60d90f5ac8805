// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is left behind in the end, also of several runs together.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"
#include "coarse_map_nav/evaluation/report_context.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cmn {

/// Writes the files beside episodes.csv, and prints the last lines on the terminal.
void leave_report(const std::vector<EpisodeRow>& rows, const ReportContext& context,
                  const std::filesystem::path& out);

/// The command as a shell would take it.
std::string command_line(int argc, char** argv);

/// "Intel(R) Xeon(R) CPU @ 2.10GHz, 2 threads, Linux 6.1.0": the machine that this runs on.
std::string machine_text();

/// cmn_evaluate merge DIR... --out DIR. Returns the exit code.
int merge(int argc, char** argv);

}  // namespace cmn
