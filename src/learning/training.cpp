// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/training.hpp"

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/learning/training_log.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>

#include "checkpoint.hpp"
#include "model_export.hpp"
#include "networks.hpp"
#include "tensors.hpp"
#include <torch/torch.h>

namespace cmn {
namespace {

namespace F = torch::nn::functional;

constexpr std::size_t kWarmUpSteps = 100;

/// Examples as the networks take them.
struct Batch {
  torch::Tensor panorama;
  torch::Tensor near;
  torch::Tensor wide;
};

Batch batch_of(const std::vector<Example>& examples, torch::Device device) {
  std::vector<ColorPanorama> panoramas;
  panoramas.reserve(examples.size());
  for (const Example& example : examples) {
    panoramas.push_back(example.panorama);
  }
  return {panoramas_tensor(panoramas).to(device), near_tensor(examples).to(device),
          wide_tensor(examples).to(device)};
}

/// Mean over cells of the occupancy's entropy, cells in sight alone, and of the confidence's.
torch::Tensor square_loss(const torch::Tensor& logits, const torch::Tensor& truth,
                          double in_sight_weight) {
  const torch::Tensor occupied = (truth % 2).to(torch::kFloat);
  const torch::Tensor seen = truth.ge(kTruthSeen).to(torch::kFloat);
  const torch::Tensor of_occupancy =
      torch::binary_cross_entropy_with_logits(logits.select(1, 0), occupied, seen, {},
                                              at::Reduction::Sum) /
      seen.sum().clamp_min(1.0);
  if (logits.size(1) == 1) {
    return of_occupancy;
  }
  return of_occupancy +
         in_sight_weight * F::binary_cross_entropy_with_logits(logits.select(1, 1), seen);
}

torch::Tensor loss_of(const Logits& logits, const Batch& batch, double in_sight_weight) {
  const torch::Tensor near = square_loss(logits.near, batch.near, in_sight_weight);
  return logits.wide.defined() ? near + square_loss(logits.wide, batch.wide, in_sight_weight)
                               : near;
}

/// Probabilities of one square of one example; the confidence 1 where none is stated.
LocalOccupancy predicted_square(const torch::Tensor& logits, double side_m) {
  torch::Tensor square = torch::sigmoid(logits).cpu();
  if (square.size(0) == 1) {
    square = torch::cat({square, torch::ones_like(square)});
  }
  return local_occupancy(square, side_m, 0.0);
}

/// One to three views, any set as likely as another.
std::array<bool, kViewCount> drawn_views(std::mt19937_64& rng) {
  const std::size_t set = 1 + draw_index(rng, 14);  // of 1 to 14 of the 16, as bits
  std::array<bool, kViewCount> is_drawn{};
  for (std::size_t k = 0; k < kViewCount; ++k) {
    is_drawn[k] = ((set >> k) & 1U) != 0;
  }
  return is_drawn;
}

/// What makes a training the one it is.
std::string identity_of(const TrainingJob& job) {
  std::ostringstream text;
  text << "seed: " << job.seed << ", examples: " << job.data;
  if (!job.start_from.empty()) {
    text << ", start_from: " << job.start_from;
  }
  for (const ParamDoc& param : list_params(job.params)) {
    text << ", " << param.path << ": " << param.default_value;
  }
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file{path};
  file << text;
  if (!file.flush()) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

class Trainer {
 public:
  explicit Trainer(const TrainingJob& job)
      : job_{job},
        training_{job.data, Split::kTrain},
        validation_{job.data, Split::kValidation},
        net_{seeded_network()},
        adam_{net_->parameters(), torch::optim::AdamOptions(job.params.learning_rate)
                                      .weight_decay(job.params.weight_decay)} {
    if (std::filesystem::exists(checkpoint_path())) {
      state_ = load_checkpoint(checkpoint_path(), identity_of(job_), *net_, adam_);
    } else if (!job.start_from.empty()) {
      load_weights(job.start_from, *net_);
    }
  }

  TrainingOutcome run() {
    while (!is_finished()) {
      if (!train_epoch()) {
        return {false, state_.rows};
      }
      end_epoch();
    }
    return {true, state_.rows};
  }

 private:
  std::shared_ptr<PredictorNet> seeded_network() {
    torch::set_num_threads(job_.threads);
    torch::manual_seed(job_.seed);
    auto net = make_network(job_.params.network);
    net->to(device_);
    return net;
  }

  std::string checkpoint_path() const { return job_.out + "/checkpoint.pt"; }
  bool is_finished() const {
    return state_.epoch >= job_.params.epochs || state_.epochs_since_best >= job_.params.patience;
  }
  std::size_t batch_size() const { return static_cast<std::size_t>(job_.params.batch); }
  std::size_t batches() const { return (training_.size() + batch_size() - 1) / batch_size(); }

  double learning_rate() const {
    if (job_.params.schedule == "constant") {
      return job_.params.learning_rate;
    }
    const auto step =
        static_cast<double>(static_cast<std::size_t>(state_.epoch) * batches() + state_.batch);
    const double steps = static_cast<double>(job_.params.epochs) * static_cast<double>(batches());
    const double rise = std::min(1.0, (step + 1.0) / static_cast<double>(kWarmUpSteps));
    return job_.params.learning_rate * rise * 0.5 * (1.0 + std::cos(kPi * step / steps));
  }

  /// The examples of the next step, as the seed wants them.
  std::vector<Example> next_examples(const std::vector<std::size_t>& order) {
    std::seed_seq mixed{static_cast<std::uint32_t>(job_.seed), 1U,
                        static_cast<std::uint32_t>(state_.epoch),
                        static_cast<std::uint32_t>(state_.batch)};
    std::mt19937_64 rng{mixed};
    std::vector<Example> examples;
    const std::size_t first = state_.batch * batch_size();
    for (std::size_t i = first; i < std::min(first + batch_size(), order.size()); ++i) {
      Example example = training_.read(order[i]);
      if (job_.params.augment) {
        example = turned(example, static_cast<int>(draw_index(rng, 4)));
        example = draw_index(rng, 2) == 0 ? example : mirrored(example);
      }
      if (job_.params.black_share > 0.0 && draw_uniform(rng) < job_.params.black_share) {
        example = blacked_out(example, drawn_views(rng));
      }
      examples.push_back(std::move(example));
    }
    return examples;
  }

  double step(const Batch& batch) {
    for (auto& group : adam_.param_groups()) {
      group.options().set_lr(learning_rate());
    }
    adam_.zero_grad();
    const torch::Tensor loss =
        loss_of(net_->forward(batch.panorama), batch, job_.params.in_sight_weight);
    const double value = loss.item<double>();
    if (!std::isfinite(value)) {
      throw std::runtime_error(job_.out + ": the loss is not finite; take a lower learning_rate");
    }
    loss.backward();
    adam_.step();
    return value;
  }

  /// False when it was stopped.
  bool train_epoch() {
    net_->train();
    const std::vector<std::size_t> order =
        shuffled_order(training_.size(), job_.seed, static_cast<std::uint64_t>(state_.epoch));
    while (state_.batch < batches()) {
      if (job_.should_stop()) {
        save_checkpoint(checkpoint_path(), identity_of(job_), *net_, adam_, state_);
        return false;
      }
      const auto start = std::chrono::steady_clock::now();
      state_.loss_sum += step(batch_of(next_examples(order), device_));
      ++state_.batch;
      state_.seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      job_.tell({state_.epoch + 1, state_.batch, batches(),
                 state_.loss_sum / static_cast<double>(state_.batch)});
      if (state_.batch % static_cast<std::size_t>(job_.checkpoint_batches) == 0) {
        save_checkpoint(checkpoint_path(), identity_of(job_), *net_, adam_, state_);
      }
    }
    return true;
  }

  /// The row of the epoch that is through.
  EpochRow validated() {
    const torch::NoGradGuard no_gradient;
    net_->eval();
    std::vector<std::size_t> order = shuffled_order(validation_.size(), 0, 0);
    order.resize(std::min(order.size(), static_cast<std::size_t>(job_.params.validation_examples)));
    double loss_sum = 0.0;
    SquareScore near;
    SquareScore wide;
    for (std::size_t first = 0; first < order.size(); first += batch_size()) {
      std::vector<Example> examples;
      for (std::size_t i = first; i < std::min(first + batch_size(), order.size()); ++i) {
        examples.push_back(validation_.read(order[i]));
      }
      const Batch batch = batch_of(examples, device_);
      const Logits logits = net_->forward(batch.panorama);
      loss_sum += loss_of(logits, batch, job_.params.in_sight_weight).item<double>() *
                  static_cast<double>(examples.size());
      for (std::size_t i = 0; i < examples.size(); ++i) {
        const auto row = static_cast<int64_t>(i);
        near.add(predicted_square(logits.near[row], kNearSide_m), examples[i].near);
        if (logits.wide.defined()) {
          wide.add(predicted_square(logits.wide[row], kWideSide_m), examples[i].wide);
        }
      }
    }
    return {state_.epoch + 1,
            state_.seconds,
            learning_rate(),
            state_.loss_sum / static_cast<double>(state_.batch),
            loss_sum / static_cast<double>(order.size()),
            near.seen.average_precision(),
            near.seen.intersection_over_union(),
            near.seen.calibration_error(),
            wide.seen.average_precision()};
  }

  void end_epoch() {
    const EpochRow row = validated();
    state_.rows.push_back(row);
    ++state_.epoch;
    state_.batch = 0;
    state_.loss_sum = 0.0;
    ++state_.epochs_since_best;
    if (row.validation_loss < state_.best_loss) {
      state_.best_loss = row.validation_loss;
      state_.epochs_since_best = 0;
      export_model(*net_, job_.params.network, job_.out + "/model.pt", true);
    }
    write_text(job_.out + "/log.csv", training_csv(state_.rows));
    write_text(job_.out + "/log.svg",
               training_plot(state_.rows, "Training of \"" + job_.params.network + "\", seed " +
                                              std::to_string(job_.seed)));
    save_checkpoint(checkpoint_path(), identity_of(job_), *net_, adam_, state_);
  }

  TrainingJob job_;
  torch::Device device_{torch::cuda::is_available() ? torch::kCUDA : torch::kCPU};
  ExampleSet training_;
  ExampleSet validation_;
  std::shared_ptr<PredictorNet> net_;
  torch::optim::Adam adam_;
  TrainingState state_;
};

}  // namespace

TrainingOutcome train(const TrainingJob& job) { return Trainer{job}.run(); }

PredictionScores evaluate_predictor(OccupancyPredictor& predictor, ExampleSet& examples,
                                    std::size_t most, std::uint64_t seed) {
  std::vector<std::size_t> order = shuffled_order(examples.size(), seed, 0);
  order.resize(std::min(order.size(), most));
  PredictionScores scores;
  for (const std::size_t index : order) {
    const Example example = examples.read(index);
    const PredictedOccupancy predicted = predictor.predict(example.panorama);
    scores.near.add(predicted.near, example.near);
    if (predicted.wide) {
      scores.wide.add(*predicted.wide, example.wide);
    }
    ++scores.examples;
  }
  return scores;
}

}  // namespace cmn
