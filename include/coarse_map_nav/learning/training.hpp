// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Training a predictor, in pieces as long as one likes.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/learning/example_set.hpp"
#include "coarse_map_nav/learning/prediction_score.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cmn {

/// CMN section IV-B: Adam, 1e-4, weight decay 1e-7, binary cross-entropy. The rest is ours.
struct TrainingParams {
  std::string network = "wedge";
  int batch = 32;
  double learning_rate = 1e-4;
  std::string schedule = "constant";
  double weight_decay = 1e-7;
  int epochs = 30;
  int patience = 5;
  int validation_examples = 1000;
  bool augment = true;
  double black_share = 0.0;
  double in_sight_weight = 0.5;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("network", self.network, OneOf{{"wedge", "cmn"}},
          "wedge: ours, views laid out in the plane; cmn: ResNet18 as in the paper");
    visit("batch", self.batch, Between{1, 4096}, "[panoramas] in a step");
    visit("learning_rate", self.learning_rate, Between{1e-7, 1.0}, "[-] of Adam (CMN)");
    visit("schedule", self.schedule, OneOf{{"constant", "cosine"}},
          "cosine: rises over 100 steps, then falls to 0 at the last of the epochs");
    visit("weight_decay", self.weight_decay, Between{0.0, 1.0}, "[-] of Adam (CMN)");
    visit("epochs", self.epochs, Between{1, 100000}, "[-] at most");
    visit("patience", self.patience, Between{1, 100000},
          "[epochs] without a better validation loss end the training");
    visit("validation_examples", self.validation_examples, Between{1, 1e9},
          "[panoramas] at most that are validated on");
    visit("augment", self.augment, Anything{}, "mirror and turn the training examples at random");
    visit("black_share", self.black_share, Between{0.0, 1.0},
          "[-] of the training examples lose one to three views, as a robot's that looks ahead "
          "alone");
    visit("in_sight_weight", self.in_sight_weight, Between{0.0, 100.0},
          "[-] of the loss of the confidence beside that of the occupancy");
  }
};

/// What stands in a row of the log, one an epoch.
struct EpochRow {
  int epoch = 0;               ///< from 1
  double seconds = 0.0;        ///< of computing since the start of the training
  double learning_rate = 0.0;  ///< of its last step
  double train_loss = 0.0;     ///< mean over the epoch
  double validation_loss = 0.0;
  // Near square, cells in sight.
  double average_precision = 0.0;  ///< of free space
  double iou = 0.0;                ///< of free space
  double calibration_error = 0.0;
  double wide_average_precision = 0.0;  ///< NaN for networks that do not look that far
};

struct TrainingProgress {
  int epoch = 0;  ///< from 1
  std::size_t batch = 0;
  std::size_t batches = 0;
  double loss = 0.0;  ///< mean over the epoch so far
};

struct TrainingJob {
  std::string data;        ///< folder of examples
  std::string out;         ///< folder that exists; goes on from the checkpoint that lies there
  std::string start_from;  ///< another training's checkpoint: the first weights; empty: drawn
  std::uint64_t seed = 1;
  int threads = 1;
  int checkpoint_batches = 200;  ///< between two checkpoints
  TrainingParams params;
  /// Asked after every step; true: a checkpoint is written and train() returns.
  std::function<bool()> should_stop = [] { return false; };
  std::function<void(const TrainingProgress&)> tell = [](const TrainingProgress&) {};
};

struct TrainingOutcome {
  bool is_finished = false;  ///< false: stopped, to be gone on with
  std::vector<EpochRow> rows;
};

/// Trains and leaves in `out`: checkpoint.pt, log.csv, log.svg, and the model of the epoch with the
/// lowest validation loss as model.pt (torch_predictor.hpp), its weights in 16 bits.
///
/// The same examples, parameters and seed give the same model, however often it was stopped or
/// killed and gone on with (on a CPU, with the same number of threads); only `seconds` differs.
/// Throws std::runtime_error for data that cannot be read, a checkpoint that is damaged or of other
/// parameters, files that cannot be written, or a build without LibTorch.
TrainingOutcome train(const TrainingJob& job);

/// How a predictor does on examples, at most `most` of them, drawn from a seed.
struct PredictionScores {
  SquareScore near;
  SquareScore wide;  ///< empty when the predictor does not look that far
  std::size_t examples = 0;
};
PredictionScores evaluate_predictor(OccupancyPredictor& predictor, ExampleSet& examples,
                                    std::size_t most, std::uint64_t seed);

}  // namespace cmn
