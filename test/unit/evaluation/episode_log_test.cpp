// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_log.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fake_episodes.hpp"
#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class EpisodeLogTest : public ::testing::Test {
 protected:
  EpisodeLogTest() { fs::remove_all(folder_); }

  std::string text() const {
    std::ostringstream text;
    text << std::ifstream{folder_ / "episodes.csv"}.rdbuf();
    return text.str();
  }

  const fs::path folder_ = fs::path{::testing::TempDir()} / "episode_log" /
                           ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(EpisodeLogTest, EveryRowIsThereAtOnce) {
  EpisodeLog log{folder_.string(), false};
  EXPECT_EQ(text(), csv_header() + "\n");
  log.add(failed_episode("ours", 1));
  EXPECT_EQ(text(), csv_header() + "\n" + csv_line(failed_episode("ours", 1)) + "\n");
}

TEST_F(EpisodeLogTest, InTheEndTheOrderIsThatOfTheKeys) {
  EpisodeLog log{folder_.string(), false};
  log.add(failed_episode("ours", 1));
  log.add(failed_episode("ours", 0));
  log.finish();
  EXPECT_EQ(text(), csv_header() + "\n" + csv_line(failed_episode("ours", 0)) + "\n" +
                        csv_line(failed_episode("ours", 1)) + "\n");
  ASSERT_NE(log.find("CL-0.40-intel-1-ours"), nullptr);
  EXPECT_EQ(log.find("CL-0.40-intel-1-ours")->key.index, 1);
  EXPECT_EQ(log.find("CL-0.40-intel-2-ours"), nullptr);
  log.add(failed_episode("ours", 2));
  EXPECT_EQ(text().substr(text().size() - 1), "\n");
  EXPECT_THAT(text(), HasSubstr(csv_line(failed_episode("ours", 2))));
}

TEST_F(EpisodeLogTest, GoesOnOnlyWhenAskedTo) {
  { EpisodeLog{folder_.string(), false}.add(failed_episode("ours", 0)); }
  std::ofstream{folder_ / "episodes.csv", std::ios::app} << "CL,intel,0.4,ou";  // power cut
  EXPECT_THAT(error_of([&] { EpisodeLog(folder_.string(), false); }),
              HasSubstr("episodes.csv has 1 episodes: --resume"));
  EpisodeLog log{folder_.string(), true};
  EXPECT_EQ(log.rows().size(), 1U);
  log.add(failed_episode("ours", 1));
  EXPECT_EQ(EpisodeLog(folder_.string(), true).rows().size(), 2U);
}

TEST_F(EpisodeLogTest, AFolderThatCannotBeMadeIsNamed) {
  const std::string file = file_with("file", "in the way");
  EXPECT_THAT(error_of([&] { EpisodeLog(file, false); }), HasSubstr(file));
}

}  // namespace
}  // namespace cmn
