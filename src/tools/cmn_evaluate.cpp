// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_evaluate: every method on every building, judged; the tables by which this package is
/// judged.

#include "coarse_map_nav/mapping/map_reader.hpp"

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cmn_evaluate/evaluation.hpp"
#include "cmn_evaluate/gallery.hpp"
#include "cmn_evaluate/merge.hpp"
#include "cmn_evaluate/replay.hpp"
#include "version/cmn_version.hpp"
#include <boost/program_options.hpp>

namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

volatile std::sig_atomic_t interrupts = 0;
volatile std::time_t interrupted_s = 0;

/// The first Ctrl-C lets the episodes that are under way come to their end, one more a second later
/// kills. (What starts us may send the same signal twice.)
void interrupt(int signal) {
  const std::time_t now_s = std::time(nullptr);
  if (interrupts == 0) {
    interrupts = 1;
    interrupted_s = now_s;
  } else if (now_s > interrupted_s + 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

std::vector<std::string> split(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    std::istringstream in{text};
    for (std::string part; std::getline(in, part, ',');) {
      parts.push_back(part);
    }
  }
  return parts;
}

/// What stands after an option, several with commas. Throws std::runtime_error when that is nothing
/// or something twice.
std::vector<std::string> list_of(const po::variables_map& given, const std::string& option) {
  const std::vector<std::string> parts = split(given[option].as<std::vector<std::string>>());
  std::set<std::string> known;
  for (const std::string& part : parts) {
    if (!known.insert(part).second) {
      throw std::runtime_error("--" + option + " names " + part + " twice");
    }
  }
  if (parts.empty()) {
    throw std::runtime_error("--" + option + " names nothing");
  }
  return parts;
}

int positive(const po::variables_map& given, const std::string& option) {
  const int value = given[option].as<int>();
  if (value < 1) {
    throw std::runtime_error("--" + option + " " + std::to_string(value) + " is not 1 or more");
  }
  return value;
}

/// The folder that has config/ and urdf/: beside the installed program, or the source tree that it
/// was built from.
fs::path find_share() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (fs::path at = program.parent_path(); at != at.root_path(); at = at.parent_path()) {
    for (const fs::path& dir : {at / "share" / "coarse_map_nav", at}) {
      if (fs::exists(dir / "config" / "cmn.yaml")) {
        return dir;
      }
    }
  }
  throw std::runtime_error("the folders config and urdf were not found: give --config and --robot");
}

/// Throws std::runtime_error when it is none, or finer than the names of episodes show.
double resolution_of(const std::string& text) {
  std::size_t used = 0;
  double mpp = 0.0;
  try {
    mpp = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(mpp > 0.0) ||
      std::abs(100.0 * mpp - std::round(100.0 * mpp)) > 1e-9) {
    throw std::runtime_error("--mpp " + text + " is not a resolution in whole centimetres, as 0.4");
  }
  return mpp;
}

/// The variants that a run may name.
cmn::Variants variants_for(const po::variables_map& given, const fs::path& config) {
  if (given.count("variants") != 0) {
    return cmn::read_variants(given["variants"].as<std::string>());
  }
  const fs::path shipped = config / "variants" / "ablation.yaml";
  return fs::exists(shipped) ? cmn::read_variants(shipped.string()) : cmn::Variants{};
}

/// The methods of some ids of episodes.
std::set<std::string> methods_in(const std::vector<std::string>& ids) {
  std::set<std::string> methods;
  for (const std::string& id : ids) {
    methods.insert(cmn::parse_episode_id(id).method);
  }
  return methods;
}

/// "planning/policy: lattice, ...".
std::string changes_text(const cmn::ParamTree& changes) {
  std::ostringstream text;
  for (const auto& [name, value] : changes) {
    text << (text.tellp() == 0 ? "" : ", ") << name << ": ";
    std::visit([&text](const auto& v) { text << std::boolalpha << v; }, value);
  }
  return text.str();
}

/// Changes `judge` as a file says. Throws std::runtime_error naming every problem of it.
cmn::ParamTree judge_changes(const std::string& file, cmn::JudgeParams& judge) {
  const cmn::ParamTree tree = cmn::read_param_file(file);
  std::string faults;
  for (const std::string& problem : cmn::load_params(tree, judge)) {
    faults += "\n  " + problem;
  }
  if (!faults.empty()) {
    throw std::runtime_error(file + ":" + faults);
  }
  return tree;
}

/// Those to be explained. Throws std::runtime_error when one is no number of an action.
std::vector<int> actions_of(const po::variables_map& given) {
  std::vector<int> actions;
  for (const std::string& text : list_of(given, "explain")) {
    if (text.size() > 6 || text.find_first_not_of("0123456789") != std::string::npos) {
      throw std::runtime_error("--explain " + text + " is not the number of an action");
    }
    actions.push_back(std::stoi(text));
  }
  return actions;
}

po::options_description all_options() {
  po::options_description options{
      "cmn_evaluate --world W.yaml [--world ...] --task CL --mpp 0.4 --method ours,cmn --out "
      "DIR\n\n"
      "Options"};
  auto add_option = options.add_options();
  add_option("help", "print this");
  add_option("world", po::value<std::vector<std::string>>()->multitoken()->composing(),
             "metric worlds: map_server yaml, generated homes as house:7 or house:1-50; with "
             "heights: Gazebo's .world or .sdf, homes as furnished:7 or furnished:1-50");
  add_option(
      "task",
      po::value<std::vector<std::string>>()->multitoken()->composing()->default_value({"CL"}, "CL"),
      "CG, CI, HD, CL, CD, CF, HL, WL, TL; CLK, CFK, HLK, WLK: likewise, kidnapped once; several "
      "with "
      "commas");
  add_option("mpp",
             po::value<std::vector<std::string>>()->multitoken()->composing()->default_value(
                 {"0.4"}, "0.4"),
             "[m/cell] of the drawing; several with commas");
  add_option("method",
             po::value<std::vector<std::string>>()->multitoken()->composing()->default_value(
                 {"ours"}, "ours"),
             "several with commas; ours+VARIANT: with one part changed; ours+all: with each");
  add_option("map", po::value<std::string>(),
             "a drawing of the only world, which then has the --mpp of its own; in place of those "
             "that the tasks make");
  add_option("map-to-world", po::value<std::string>(),
             "yaml file of its `places`, here and there; default: the drawing's own");
  add_option("variants", po::value<std::string>(),
             "file of the VARIANTs; default: variants/ablation.yaml of --config");
  add_option("episodes", po::value<int>()->default_value(50), "in each world");
  add_option("seed", po::value<std::int64_t>()->default_value(1), "of starts, goals and noise");
  add_option("jobs", po::value<int>()->default_value(1), "threads; the result is the same for any");
  add_option("shard", po::value<std::string>()->default_value("0/1"), "i/n: every n-th episode");
  add_option("out", po::value<std::string>()->required(), "folder of episodes.csv and the report");
  add_option("config", po::value<std::string>(), "folder of the presets");
  add_option("robot", po::value<std::string>(),
             "its description (URDF), for where its sensors are in worlds with heights; default: "
             "urdf/locobot.urdf");
  add_option("model", po::value<std::string>(),
             "the network (TorchScript) of tasks and methods that look in colour; default: "
             "models/wedge.pt");
  add_option("judge", po::value<std::string>(),
             "yaml file of what is to differ of the judge and the simulated robot, as "
             "{least_way_m: 1, simulation: {robot: {radius_m: 0.1}}}");
  add_option("resume", po::bool_switch(), "go on with what lies in --out");
  add_option("replay", po::value<std::vector<std::string>>()->multitoken()->composing(),
             "run only these episodes again, as CL-0.40-intel-17-ours, and draw them");
  add_option("explain", po::value<std::vector<std::string>>()->multitoken()->composing(),
             "with --replay: before these actions, counted from 0, take apart what each part of "
             "the method makes of what is seen; several with commas");
  add_option("gallery", po::value<int>(),
             "run only so many of the worst episodes in --out again, of each --method, and draw "
             "them with their causes");
  return options;
}

/// A drawing in place of those that the tasks make.
void take_drawing(const po::variables_map& given, cmn::Plan& plan) {
  plan.map = given["map"].as<std::string>();
  plan.map_to_world =
      given.count("map-to-world") != 0 ? given["map-to-world"].as<std::string>() : plan.map;
  if (plan.worlds.size() != 1 || !given["mpp"].defaulted()) {
    throw std::runtime_error("--map goes with a single --world and without --mpp");
  }
  std::ostringstream mpp;
  mpp << cmn::read_map(plan.map).resolution();
  plan.mpps = {resolution_of(mpp.str())};
}

/// All but its methods. Throws std::runtime_error naming the option at fault.
cmn::Plan plan_of(const po::variables_map& given) {
  cmn::Plan plan;
  if (given.count("world") != 0) {
    plan.worlds = cmn::expand_houses(split(given["world"].as<std::vector<std::string>>()));
  }
  if (plan.worlds.empty()) {
    throw std::runtime_error("give at least one --world");
  }
  plan.tasks = list_of(given, "task");
  for (const std::string& mpp : list_of(given, "mpp")) {
    plan.mpps.push_back(resolution_of(mpp));
  }
  if (given.count("map") != 0) {
    take_drawing(given, plan);
  }
  plan.episodes = positive(given, "episodes");
  plan.jobs = positive(given, "jobs");
  if (given["seed"].as<std::int64_t>() < 0) {
    throw std::runtime_error("--seed is not 0 or more");
  }
  plan.seed = static_cast<std::uint64_t>(given["seed"].as<std::int64_t>());
  if (std::sscanf(given["shard"].as<std::string>().c_str(), "%d/%d", &plan.shard, &plan.shards) !=
          2 ||
      plan.shards < 1 || plan.shard < 0 || plan.shard >= plan.shards) {
    throw std::runtime_error("--shard is i/n with 0 <= i < n");
  }
  plan.out = given["out"].as<std::string>();
  plan.config = given.count("config") != 0 ? fs::path{given["config"].as<std::string>()}
                                           : find_share() / "config";
  plan.robot = given.count("robot") != 0 ? fs::path{given["robot"].as<std::string>()}
                                         : find_share() / "urdf" / "locobot.urdf";
  if (given.count("robot") != 0 && !fs::exists(plan.robot)) {
    throw std::runtime_error("--robot " + plan.robot.string() + " does not exist");
  }
  plan.model = given.count("model") != 0 ? given["model"].as<std::string>()
                                         : (find_share() / "models" / "wedge.pt").string();
  plan.resume = given["resume"].as<bool>();
  return plan;
}

/// How its episodes are made; `judge` are the changes of the judge.
cmn::ReportContext context_of(const cmn::Plan& plan, const cmn::ParamTree& judge) {
  cmn::ReportContext context;
  context.machine = cmn::machine_text();
  context.version = CMN_VERSION;
  context.seed = plan.seed;
  context.robot_radius_m = plan.judge.simulation.robot.radius_m;
  context.success_radius_m = plan.judge.success_radius_m;
  context.settings.emplace_back("judge", judge.empty() ? "as shipped" : changes_text(judge));
  context.settings.emplace_back("robot", plan.robot.filename().string());
  context.settings.emplace_back(
      "furniture", fs::exists(cmn::kFurnitureFolder) ? "meshes, where there are heights" : "boxes");
  if (!plan.map.empty()) {
    context.settings.emplace_back("map", plan.map + " with " + plan.map_to_world);
  }
  for (const cmn::Method& method : plan.methods) {
    if (!method.changes.empty()) {
      context.settings.emplace_back(method.name, changes_text(method.changes));
    }
  }
  return context;
}

/// Throws std::runtime_error when what lies in --out was made in another way.
void require_the_same(const cmn::ReportContext& context, const fs::path& file) {
  if (!fs::exists(file)) {
    return;
  }
  const cmn::ReportContext before = cmn::read_context(file.string());
  if (!cmn::are_alike(before, context)) {
    throw std::runtime_error(
        "--resume needs the options and the version of the run that it goes "
        "on with: " +
        before.command + "\n  " + file.string() + " has what they were");
  }
}

/// Plays what is not played yet. Returns the exit code.
int evaluate(const cmn::Plan& plan, cmn::ReportContext context) {
  const double start_s = cmn::seconds();
  const std::string description = (plan.out / "run.yaml").string();
  cmn::EpisodeLog log{plan.out.string(), plan.resume};
  cmn::Evaluation evaluation{plan, log};
  context.horizon = evaluation.horizon();
  if (!log.rows().empty()) {
    require_the_same(context, description);
  }
  context.is_interrupted = true;  // until the end, which a run that is killed never sees
  cmn::write_context(context, description);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  evaluation.run([] { return interrupts != 0; });
  log.finish();
  context.wall_time_s = cmn::seconds() - start_s;
  context.is_interrupted = interrupts != 0;
  cmn::leave_report(log.rows(), context, plan.out);
  if (context.is_interrupted) {
    std::cerr << "cmn_evaluate: interrupted; the same command with --resume goes on\n";
    return 130;  // as the shell does
  }
  return EXIT_SUCCESS;
}

int run(int argc, char** argv) {
  const po::options_description options = all_options();
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("help") != 0) {
    std::cout << options;
    return EXIT_SUCCESS;
  }
  po::notify(given);
  cmn::Plan plan = plan_of(given);
  cmn::ParamTree judge;
  if (given.count("judge") != 0) {
    judge = judge_changes(given["judge"].as<std::string>(), plan.judge);
  }
  std::vector<std::string> replayed;
  if (given.count("replay") != 0) {
    replayed = split(given["replay"].as<std::vector<std::string>>());
  }
  const std::set<std::string> methods_replayed = methods_in(replayed);
  plan.methods = cmn::methods_named(
      replayed.empty() ? list_of(given, "method")
                       : std::vector<std::string>{methods_replayed.begin(), methods_replayed.end()},
      variants_for(given, plan.config), plan.config.string());
  if (!replayed.empty()) {
    cmn::replay(plan, replayed,
                given.count("explain") != 0 ? actions_of(given) : std::vector<int>{});
    return EXIT_SUCCESS;
  }
  if (given.count("explain") != 0) {
    throw std::runtime_error("--explain goes with --replay");
  }
  if (given.count("gallery") != 0) {
    cmn::leave_gallery(plan, static_cast<std::size_t>(positive(given, "gallery")));
    return EXIT_SUCCESS;
  }
  cmn::ReportContext context = context_of(plan, judge);
  context.command = cmn::command_line(argc, argv);
  return evaluate(plan, std::move(context));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return argc > 1 && std::string{argv[1]} == "merge" ? cmn::merge(argc, argv) : run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "cmn_evaluate: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
}
