// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// episodes.csv while it grows.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <cstddef>
#include <fstream>
#include <string>
#include <unordered_map>
#include <vector>

namespace cmn {

/// Writes rows as they come, so that an interrupted run keeps what is done. All members throw
/// std::runtime_error naming the file when it cannot be written.
class EpisodeLog {
 public:
  /// Makes the folder where needed. Rows that are there already are kept when `resume`; otherwise
  /// it is an error that there are any.
  EpisodeLog(const std::string& folder, bool resume);

  const std::vector<EpisodeRow>& rows() const { return rows_; }
  /// The row of an episode, by the id of its key; null when it is not there.
  const EpisodeRow* find(const std::string& id) const;
  void add(const EpisodeRow& row);
  /// Sorts the file by the keys: it is then the same for any number of threads.
  void finish();

 private:
  void rewrite();
  void check();

  std::string path_;
  std::ofstream stream_;
  std::vector<EpisodeRow> rows_;
  std::unordered_map<std::string, std::size_t> row_of_;  ///< by id
};

}  // namespace cmn
