// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_params: prints all parameters with their defaults, and checks preset files.

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/learning/example_renderer.hpp"
#include "coarse_map_nav/learning/training.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.hpp"
#include <boost/program_options.hpp>

namespace {

namespace po = boost::program_options;

/// What a preset may hold: every node loads all of it.
struct PresetParams {
  cmn::NavigatorParams navigator;
  cmn::FrameParams frames;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    cmn::NavigatorParams::visit_params(self.navigator, visit);
    visit.group("frames", self.frames);
  }
};

/// A heading of docs/parameters.md and what stands under it.
struct Chapter {
  std::string title;
  std::string text;
  std::vector<cmn::ParamDoc> params;
};

std::vector<Chapter> chapters() {
  const std::string own = "Its own, besides the preset and the frames.";
  return {
      {"Preset", "Groups of the files in `config/`. Every node takes them.",
       cmn::list_params(cmn::NavigatorParams{})},
      {"Frames", "Of every node, in group `frames`.", cmn::list_params(cmn::FrameParams{})},
      {"simulator", own, cmn::list_params(cmn::SimulatorNodeParams{})},
      {"coarse_map_server", own, cmn::list_params(cmn::MapServerParams{})},
      {"perception", own, cmn::list_params(cmn::PerceptionNodeParams{})},
      {"localizer", own, cmn::list_params(cmn::LocalizerNodeParams{})},
      {"planner", own, cmn::list_params(cmn::PlannerNodeParams{})},
      {"motion_controller", own, cmn::list_params(cmn::MotionNodeParams{})},
      {"cmn_dataset", "Of the file that `cmn_dataset --params` takes.",
       cmn::list_params(cmn::ExampleParams{})},
      {"cmn_train", "Of the file that `cmn_train --params` takes.",
       cmn::list_params(cmn::TrainingParams{})},
  };
}

std::string in_a_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '|' ? "\\|" : std::string(1, c);
  }
  return escaped;
}

void print_markdown() {
  std::cout << "<!-- Made by `scripts/run cmn_params --markdown > docs/parameters.md`. -->\n"
               "# Parameters\n\n"
               "All are private parameters of their node, read once at its start. A value that is "
               "outside its range, of\nanother type, or whose name nobody knows ends the node with "
               "exit code 1 and a list of all such problems.\n"
               "`scripts/run cmn_params --check FILE.yaml` finds them in a preset beforehand.\n";
  for (const Chapter& chapter : chapters()) {
    std::cout << "\n## " << chapter.title << "\n\n"
              << chapter.text
              << "\n\n| parameter | default | range | meaning |\n|---|---|---|---|\n";
    for (const cmn::ParamDoc& param : chapter.params) {
      std::cout << "| `" << param.path << "` | `" << param.default_value << "` | "
                << in_a_cell(param.range) << " | " << in_a_cell(param.text) << " |\n";
    }
  }
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Nested maps, a comment above each value; parameters of a group follow each other.
void print_yaml() {
  std::vector<std::string> group;
  for (const cmn::ParamDoc& param : cmn::list_params(PresetParams{})) {
    std::vector<std::string> parts = parts_of(param.path);
    const std::string name = parts.back();
    parts.pop_back();
    std::size_t shared = 0;
    while (shared < group.size() && shared < parts.size() && group[shared] == parts[shared]) {
      ++shared;
    }
    for (std::size_t depth = shared; depth < parts.size(); ++depth) {
      std::cout << std::string(2 * depth, ' ') << parts[depth] << ":\n";
    }
    group = parts;
    const std::string indent(2 * parts.size(), ' ');
    std::cout << indent << "# " << param.text << "; " << param.range << "\n"
              << indent << name << ": " << param.default_value << "\n";
  }
}

/// Prints every problem of the files; true when there is none.
bool check(const std::vector<std::string>& files) {
  bool is_well = true;
  for (const std::string& file : files) {
    std::vector<std::string> problems;
    try {
      PresetParams params;
      problems = cmn::load_params(cmn::read_param_file(file), params);
      for (std::string& problem : problems) {
        problem.insert(0, file + ": ");
      }
    } catch (const std::runtime_error& e) {
      problems.emplace_back(e.what());
    }
    for (const std::string& problem : problems) {
      std::cerr << problem << "\n";
    }
    is_well = is_well && problems.empty();
    if (problems.empty()) {
      std::cout << file << ": ok\n";
    }
  }
  return is_well;
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_params --markdown | --yaml | --check FILE.yaml...\n\n"
      "Prints all parameters of the package, or says what is wrong in preset files.\n"
      "Options"};
  options.add_options()("help", "print this")("markdown", "print docs/parameters.md")(
      "yaml", "print the defaults of all that a preset may hold")(
      "check", po::value<std::vector<std::string>>()->multitoken(),
      "preset files; every problem is listed, and any makes the exit code 1");
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("markdown") != 0) {
    print_markdown();
  } else if (given.count("yaml") != 0) {
    print_yaml();
  } else if (given.count("check") != 0) {
    return check(given["check"].as<std::vector<std::string>>()) ? EXIT_SUCCESS : EXIT_FAILURE;
  } else {
    std::cout << options;
    return given.count("help") != 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
