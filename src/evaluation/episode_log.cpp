// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_log.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace cmn {

namespace fs = std::filesystem;

EpisodeLog::EpisodeLog(const std::string& folder, bool resume)
    : path_{(fs::path{folder} / "episodes.csv").string()} {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fs::exists(path_)) {
    std::ifstream in{path_};
    rows_ = read_episodes(in, path_);
  }
  if (!rows_.empty() && !resume) {
    throw std::runtime_error(path_ + " has " + std::to_string(rows_.size()) +
                             " episodes: --resume goes on with them, or give another folder");
  }
  rewrite();
}

const EpisodeRow* EpisodeLog::find(const std::string& id) const {
  const auto at = row_of_.find(id);
  return at == row_of_.end() ? nullptr : &rows_[at->second];
}

void EpisodeLog::add(const EpisodeRow& row) {
  row_of_[row.key.id()] = rows_.size();
  rows_.push_back(row);
  stream_ << csv_line(row) << "\n" << std::flush;
  check();
}

void EpisodeLog::finish() {
  std::sort(rows_.begin(), rows_.end(),
            [](const EpisodeRow& a, const EpisodeRow& b) { return a.key < b.key; });
  rewrite();
}

void EpisodeLog::rewrite() {
  stream_.close();
  // Beside it first: a run that is killed now keeps the old file.
  const std::string draft = path_ + ".part";
  stream_ = std::ofstream{draft, std::ios::trunc};
  stream_ << csv_header() << "\n";
  row_of_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    row_of_[rows_[i].key.id()] = i;
    stream_ << csv_line(rows_[i]) << "\n";
  }
  stream_.flush();
  check();
  fs::rename(draft, path_);
}

void EpisodeLog::check() {
  if (!stream_) {
    throw std::runtime_error(path_ + ": cannot be written");
  }
}

}  // namespace cmn
