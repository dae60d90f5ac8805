// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_train: trains the network that sees local occupancy in colour images, and measures one.

#include "coarse_map_nav/evaluation/progress.hpp"
#include "coarse_map_nav/learning/example_sheet.hpp"
#include "coarse_map_nav/learning/torch_predictor.hpp"
#include "coarse_map_nav/learning/training.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "needed_options.hpp"
#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <unistd.h>

namespace {

namespace po = boost::program_options;

volatile std::sig_atomic_t is_interrupted = 0;
void interrupt(int signal) {
  is_interrupted = 1;
  std::signal(signal, SIG_DFL);  // a second one kills
}

class Stopwatch {
 public:
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void print_row(const cmn::EpochRow& row) {
  std::printf("epoch %d: loss %.4f, validation %.4f; free space: AP %.4f, IoU %.4f, ECE %.4f\n",
              row.epoch, row.train_loss, row.validation_loss, row.average_precision, row.iou,
              row.calibration_error);
}

int train(const po::variables_map& given) {
  cmn::TrainingJob job;
  job.data = cmn::needed(given, "data");
  job.out = cmn::needed(given, "out");
  job.seed = given["seed"].as<std::uint64_t>();
  job.threads = given["threads"].as<int>();
  job.start_from = given.count("start-from") != 0 ? given["start-from"].as<std::string>() : "";
  job.params = cmn::params_of<cmn::TrainingParams>(given);
  if (job.threads < 1) {
    throw std::runtime_error("--threads is not 1 or more");
  }
  std::filesystem::create_directories(job.out);
  const Stopwatch watch;
  const double minutes = given["minutes"].as<double>();
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  job.should_stop = [&] {
    return is_interrupted != 0 || (minutes > 0.0 && watch.elapsed_s() >= 60.0 * minutes);
  };
  cmn::Progress progress;
  int epoch = 0;
  double epoch_start_s = 0.0;
  job.tell = [&](const cmn::TrainingProgress& now) {
    if (isatty(STDERR_FILENO) == 0) {
      return;
    }
    if (now.epoch != epoch) {
      epoch = now.epoch;
      progress.done_before = now.batch - 1;
      epoch_start_s = watch.elapsed_s();
    }
    progress.done = now.batch;
    progress.total = now.batches;
    progress.elapsed_s = watch.elapsed_s() - epoch_start_s;
    std::fprintf(stderr, "\r\033[Kepoch %d loss %.4f %s", now.epoch, now.loss,
                 cmn::progress_line(progress).c_str());
  };
  const cmn::TrainingOutcome outcome = cmn::train(job);
  if (isatty(STDERR_FILENO) != 0) {
    std::fputs("\r\033[K", stderr);
  }
  for (const cmn::EpochRow& row : outcome.rows) {
    print_row(row);
  }
  std::printf("%s; %s\n", outcome.is_finished ? "finished" : "stopped: the same command goes on",
              job.out.c_str());
  return EXIT_SUCCESS;
}

void write_sheet(const std::string& path, const std::vector<cmn::SheetRow>& rows) {
  if (rows.empty() || !cv::imwrite(path, cmn::example_sheet(rows))) {
    throw std::runtime_error(path + ": cannot be written, or there is nothing to draw");
  }
}

/// Four square views side by side, as a robot sees them that turns to the right: front, right,
/// back, left. What the camera's true field of view is nobody asks: 90 degrees are assumed.
cmn::ColorPanorama panorama_of_strip(const std::string& path) {
  const cv::Mat strip = cv::imread(path, cv::IMREAD_COLOR);
  if (strip.empty() || strip.cols != 4 * strip.rows) {
    throw std::runtime_error(path + ": is no picture of four square views side by side");
  }
  cmn::ColorPanorama panorama;
  for (int i = 0; i < 4; ++i) {
    const cv::Mat view = strip.colRange(i * strip.rows, (i + 1) * strip.rows);
    cv::resize(view, panorama.views[static_cast<std::size_t>((4 - i) % 4)],
               {cmn::kViewSide, cmn::kViewSide}, 0.0, 0.0, cv::INTER_AREA);
  }
  return panorama;
}

/// What is predicted of the pictures of a folder.
void show_strips(cmn::OccupancyPredictor& predictor, const std::string& folder,
                 const std::string& sheet) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator{folder}) {
    paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<cmn::SheetRow> rows;
  for (const std::string& path : paths) {
    const cmn::ColorPanorama panorama = panorama_of_strip(path);
    rows.push_back({panorama, std::nullopt, predictor.predict(panorama)});
  }
  write_sheet(sheet, rows);
}

void show_examples(cmn::OccupancyPredictor& predictor, cmn::ExampleSet& examples,
                   std::uint64_t seed, const std::string& sheet) {
  constexpr std::size_t kRows = 16;
  std::vector<std::size_t> order = cmn::shuffled_order(examples.size(), seed, 0);
  order.resize(std::min(order.size(), kRows));
  std::vector<cmn::SheetRow> rows;
  for (const std::size_t index : order) {
    const cmn::Example example = examples.read(index);
    rows.push_back({example.panorama, example, predictor.predict(example.panorama)});
  }
  write_sheet(sheet, rows);
}

int evaluate(const po::variables_map& given) {
  cmn::PredictorOptions options;
  options.threads = given["threads"].as<int>();
  const auto predictor = cmn::load_predictor(given["evaluate"].as<std::string>(), options);
  if (given.count("strips") != 0) {
    show_strips(*predictor, given["strips"].as<std::string>(), cmn::needed(given, "sheet"));
    return EXIT_SUCCESS;
  }
  cmn::ExampleSet examples{cmn::needed(given, "data"),
                           cmn::parse_split(given["split"].as<std::string>())};
  const auto seed = given["seed"].as<std::uint64_t>();
  if (given.count("sheet") != 0) {
    show_examples(*predictor, examples, seed, given["sheet"].as<std::string>());
    return EXIT_SUCCESS;
  }
  const Stopwatch watch;
  const cmn::PredictionScores scores =
      cmn::evaluate_predictor(*predictor, examples, given["examples"].as<std::size_t>(), seed);
  std::printf("%zu panoramas of %zu houses, %.1f ms each\n", scores.examples,
              examples.house_count(),
              1e3 * watch.elapsed_s() / static_cast<double>(scores.examples));
  std::printf("RESULT square=near %s\n", cmn::score_text(scores.near).c_str());
  if (scores.wide.in_sight.count() > 0.0) {
    std::printf("RESULT square=wide %s\n", cmn::score_text(scores.wide).c_str());
  }
  return EXIT_SUCCESS;
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_train --data EXAMPLES --out DIR [--params training.yaml] [--minutes 30]\n"
      "cmn_train --evaluate model.pt --data EXAMPLES [--split test] [--sheet look.png]\n"
      "cmn_train --evaluate model.pt --strips PICTURES --sheet look.png\n\n"
      "Trains on the examples that cmn_dataset has made, and leaves model.pt, log.csv, log.svg "
      "and\n"
      "checkpoint.pt in DIR. Stopped or killed, the same command goes on to the same result.\n"
      "docs/parameters.md lists what may stand in the file of parameters.\n"
      "Options"};
  auto add_option = options.add_options();
  add_option("help", "print this");
  add_option("data", po::value<std::string>(), "folder of examples");
  add_option("out", po::value<std::string>(), "folder of the training");
  add_option("params", po::value<std::string>(), "YAML file of parameters");
  add_option("start-from", po::value<std::string>(),
             "checkpoint.pt of another training, whose weights are the first ones");
  add_option("seed", po::value<std::uint64_t>()->default_value(1),
             "of weights and order; with --evaluate, of the examples' choice");
  add_option("threads", po::value<int>()->default_value(1),
             "of torch; more than idle cores cost time");
  add_option("minutes", po::value<double>()->default_value(0.0),
             "stop after so long, to go on later; 0: never");
  add_option("evaluate", po::value<std::string>(), "measure this TorchScript model");
  add_option("sheet", po::value<std::string>(),
             "with --evaluate: draw predictions instead of measuring them");
  add_option("strips", po::value<std::string>(),
             "folder of pictures, in each four square views of 90 degrees side by side: front, "
             "right, back, left");
  add_option("split", po::value<std::string>()->default_value("test"),
             "with --evaluate: train, validation or test");
  add_option("examples", po::value<std::size_t>()->default_value(2000),
             "with --evaluate: at most so many");
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options;
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  return given.count("evaluate") != 0 ? evaluate(given) : train(given);
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
