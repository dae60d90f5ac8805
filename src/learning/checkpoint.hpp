// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All that a training needs to go on exactly where it was.
#pragma once

#include "coarse_map_nav/learning/training.hpp"

#include <string>
#include <vector>

#include "networks.hpp"
#include <torch/torch.h>

namespace cmn {

/// Where a training is. What examples come next, and how they are turned, follows from the seed and
/// these numbers: there is no generator to be kept.
struct TrainingState {
  int epoch = 0;          ///< finished
  std::size_t batch = 0;  ///< of the epoch under way, finished
  double loss_sum = 0.0;  ///< over those
  double seconds = 0.0;
  double best_loss = 1e300;
  int epochs_since_best = 0;
  std::vector<EpochRow> rows;
};

/// `identity`: what must be the same for going on to make sense, as text.
void save_checkpoint(const std::string& path, const std::string& identity, PredictorNet& net,
                     torch::optim::Adam& adam, const TrainingState& state);

/// Throws std::runtime_error naming the file when it is damaged or of another identity.
TrainingState load_checkpoint(const std::string& path, const std::string& identity,
                              PredictorNet& net, torch::optim::Adam& adam);

/// The weights alone. Throws std::runtime_error naming the file when it is damaged or of another
/// network.
void load_weights(const std::string& path, PredictorNet& net);

}  // namespace cmn
