// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "merge.hpp"

#include "coarse_map_nav/evaluation/episode_log.hpp"
#include "coarse_map_nav/evaluation/evaluation_report.hpp"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#include <boost/program_options.hpp>
#include <sys/utsname.h>

namespace cmn {

namespace fs = std::filesystem;
namespace po = boost::program_options;

void leave_report(const std::vector<EpisodeRow>& rows, const ReportContext& context,
                  const fs::path& out) {
  write_context(context, (out / "run.yaml").string());
  write_report(rows, context, out.string());
  for (const std::string& line : result_lines(rows)) {
    std::cout << line << "\n";
  }
}

std::string command_line(int argc, char** argv) {
  std::string line = "cmn_evaluate";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool is_plain = word.find_first_of(" \t'\"\\$`*?[]()<>|&;") == std::string::npos;
    line += " " + (is_plain && !word.empty() ? word : "'" + word + "'");
  }
  return line;
}

std::string machine_text() {
  std::string model = "unknown processor";
  std::ifstream cpus{"/proc/cpuinfo"};
  for (std::string line; std::getline(cpus, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      model = line.substr(colon + 2);
      break;
    }
  }
  utsname system{};
  const std::string kernel =
      uname(&system) == 0 ? std::string{system.sysname} + " " + system.release : "unknown system";
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads, " + kernel;
}

int merge(int argc, char** argv) {
  po::options_description options{
      "cmn_evaluate merge DIR [DIR ...] --out DIR: one report of several runs, as of shards\n\n"
      "Options"};
  auto add_option = options.add_options();
  add_option("help", "print this");
  add_option("run", po::value<std::vector<std::string>>()->required(), "folder of a run");
  add_option("out", po::value<std::string>()->required(), "folder of episodes.csv and the report");
  po::positional_options_description positional;
  positional.add("run", -1);
  po::variables_map given;
  po::store(
      po::command_line_parser(argc - 1, argv + 1).options(options).positional(positional).run(),
      given);
  if (given.count("help") != 0) {
    std::cout << options;
    return EXIT_SUCCESS;
  }
  po::notify(given);
  std::vector<std::vector<EpisodeRow>> runs;
  std::vector<ReportContext> contexts;
  for (const std::string& folder : given["run"].as<std::vector<std::string>>()) {
    const std::string path = (fs::path{folder} / "episodes.csv").string();
    std::ifstream in{path};
    if (!in) {
      throw std::runtime_error(path + ": cannot be read");
    }
    runs.push_back(read_episodes(in, path));
    contexts.push_back(read_context((fs::path{folder} / "run.yaml").string()));
  }
  const fs::path out = given["out"].as<std::string>();
  ReportContext context = merge_contexts(contexts);
  context.command = command_line(argc, argv);
  const std::vector<EpisodeRow> rows = merge_episodes(runs);
  EpisodeLog log{out.string(), false};
  for (const EpisodeRow& row : rows) {
    log.add(row);
  }
  leave_report(rows, context, out);
  return EXIT_SUCCESS;
}

}  // namespace cmn
