// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint.hpp"

#include <filesystem>
#include <stdexcept>

namespace cmn {
namespace {

torch::Tensor rows_tensor(const std::vector<EpochRow>& rows) {
  torch::Tensor table = torch::empty({static_cast<int64_t>(rows.size()), 9}, torch::kDouble);
  auto* to = table.data_ptr<double>();
  for (const EpochRow& row : rows) {
    for (const double value : {static_cast<double>(row.epoch), row.seconds, row.learning_rate,
                               row.train_loss, row.validation_loss, row.average_precision, row.iou,
                               row.calibration_error, row.wide_average_precision}) {
      *to++ = value;
    }
  }
  return table;
}

std::vector<EpochRow> rows_of(const torch::Tensor& table) {
  std::vector<EpochRow> rows;
  const auto at = table.accessor<double, 2>();
  for (int64_t i = 0; i < table.size(0); ++i) {
    rows.push_back({static_cast<int>(at[i][0]), at[i][1], at[i][2], at[i][3], at[i][4], at[i][5],
                    at[i][6], at[i][7], at[i][8]});
  }
  return rows;
}

torch::Tensor numbers_tensor(const TrainingState& state) {
  return torch::tensor(
      {static_cast<double>(state.epoch), static_cast<double>(state.batch), state.loss_sum,
       state.seconds, state.best_loss, static_cast<double>(state.epochs_since_best)},
      torch::kDouble);
}

/// The file, and whose it is. Throws std::runtime_error when it is no checkpoint.
torch::IValue open_checkpoint(const std::string& path, torch::serialize::InputArchive& archive) {
  torch::IValue identity;
  try {
    archive.load_from(path);
    archive.read("identity", identity);
  } catch (const std::exception&) {
    throw std::runtime_error(path +
                             ": is no checkpoint, or is damaged; without it, the training "
                             "starts anew");
  }
  return identity;
}

void load_net(torch::serialize::InputArchive& archive, PredictorNet& net) {
  torch::serialize::InputArchive part;
  archive.read("net", part);
  net.load(part);
}

}  // namespace

void save_checkpoint(const std::string& path, const std::string& identity, PredictorNet& net,
                     torch::optim::Adam& adam, const TrainingState& state) {
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive net_archive;
  torch::serialize::OutputArchive adam_archive;
  net.save(net_archive);
  adam.save(adam_archive);
  archive.write("identity", torch::IValue{identity});
  archive.write("net", net_archive);
  archive.write("adam", adam_archive);
  archive.write("numbers", numbers_tensor(state));
  archive.write("rows", rows_tensor(state.rows));
  const std::string unfinished = path + ".part";
  try {
    archive.save_to(unfinished);
    std::filesystem::rename(unfinished, path);
  } catch (const std::exception&) {
    throw std::runtime_error(path + ": cannot be written; does the folder exist?");
  }
}

TrainingState load_checkpoint(const std::string& path, const std::string& identity,
                              PredictorNet& net, torch::optim::Adam& adam) {
  torch::serialize::InputArchive archive;
  const torch::IValue found = open_checkpoint(path, archive);
  if (!found.isString() || found.toStringRef() != identity) {
    throw std::runtime_error(path + ": belongs to a training with other settings (" +
                             (found.isString() ? found.toStringRef() : "?") + "), not to " +
                             identity + "; take another folder");
  }
  load_net(archive, net);
  torch::serialize::InputArchive adam_part;
  archive.read("adam", adam_part);
  adam.load(adam_part);
  torch::Tensor numbers;
  torch::Tensor rows;
  archive.read("numbers", numbers);
  archive.read("rows", rows);
  const auto* at = numbers.data_ptr<double>();
  return {static_cast<int>(at[0]),
          static_cast<std::size_t>(at[1]),
          at[2],
          at[3],
          at[4],
          static_cast<int>(at[5]),
          rows_of(rows)};
}

void load_weights(const std::string& path, PredictorNet& net) {
  torch::serialize::InputArchive archive;
  open_checkpoint(path, archive);
  try {
    load_net(archive, net);
  } catch (const std::exception&) {
    throw std::runtime_error(path + ": is a checkpoint of another network");
  }
}

}  // namespace cmn
