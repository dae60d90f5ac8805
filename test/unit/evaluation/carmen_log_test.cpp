// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/carmen_log.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <unistd.h>
#include <zlib.h>

namespace cmn {
namespace {

using testing::HasSubstr;

const char* const kSmallLog =
    "# message formats defined: PARAM SYNC ODOM FLASER RLASER TRUEPOS\n"
    "PARAM robot_frontlaser_offset 0.0 nohost 0\n"
    "ODOM 0 0 0 0 0 0 1.0 pippo 1.0\n"
    "ODOM 0.5 0 0 0 0 0 2.0 pippo 2.0\n"
    "ODOM 1.0 0 0 0 0 0 3.0 pippo 3.0\n"
    "FLASER 3 1.5 81.91 2.5 1.2 0.1 0 1.2 0.1 0 3.0 pippo 3.0\n"
    "ODOM 1.2 0.1 0 0 0 0 0 pippo 0\n"
    "NEFF 9.1\n"
    "ODOM 1.4 0.1 0 0 0 0 4.0 pippo 4.0\n";

std::string message_of(const std::string& text) {
  try {
    parse_carmen_log(text);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

/// A file that goes away with the test.
class TempFile {
 public:
  explicit TempFile(const std::string& name)
      : path_{(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_" + name))
                  .string()} {}
  ~TempFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(CarmenLog, ReadsScansPosesAndParameters) {
  const CarmenLog log = parse_carmen_log(kSmallLog);
  ASSERT_EQ(log.scans.size(), 1U);
  ASSERT_EQ(log.poses.size(), 4U);
  EXPECT_EQ(log.params.at("robot_frontlaser_offset"), "0.0");
  EXPECT_TRUE(log.malformed.empty());
  EXPECT_EQ(log.other_lines, 2U);
  EXPECT_TRUE(log.has_clock);
  ASSERT_EQ(log.scans[0].ranges_m.size(), 3U);
  EXPECT_FLOAT_EQ(log.scans[0].ranges_m[0], 1.5F);
  EXPECT_TRUE(std::isinf(log.scans[0].ranges_m[1])) << "81.91 m is no return";
  const CarmenPose& at = log.poses[log.scans[0].pose];
  EXPECT_EQ(at.stamp_s, 3.0);
  EXPECT_EQ(at.T_log_robot.x, 1.2);
  EXPECT_EQ(at.T_log_robot.y, 0.1);
}

TEST(CarmenLog, DropsTheOdometryLineThatRepeatsAScansPose) {
  EXPECT_EQ(parse_carmen_log(kSmallLog).repeated_poses, 1U);
}

TEST(CarmenLog, SpreadsTheCorrectionOverTheMotionSinceTheLastScan) {
  const CarmenLog log = parse_carmen_log(kSmallLog);
  // Odometry says 0, 0.5, 1.0 and the scan 1.2, 0.1: half of the motion bears half the correction.
  EXPECT_NEAR(log.poses[0].T_log_robot.x, 0.0, 1e-12);
  EXPECT_NEAR(log.poses[1].T_log_robot.x, 0.6, 1e-12);
  EXPECT_NEAR(log.poses[1].T_log_robot.y, 0.05, 1e-12);
  EXPECT_NEAR(log.poses[3].T_log_robot.x, 1.4, 1e-12) << "after the last scan as it stands";
}

TEST(CarmenLog, TakesAnyNumberOfBeams) {
  for (const int beams : {2, 180, 181, 360, 361}) {
    SCOPED_TRACE(beams);
    std::string line = "FLASER " + std::to_string(beams);
    for (int i = 0; i < beams; ++i) {
      line += " " + std::to_string(1.0 + i);
    }
    line += " 1 2 0.5 1 2 0.5 7.5 host 7.5\n";
    const CarmenLog log = parse_carmen_log(line);
    ASSERT_EQ(log.scans.size(), 1U);
    EXPECT_EQ(log.scans[0].ranges_m.size(), static_cast<std::size_t>(beams));
    EXPECT_EQ(log.poses[0].T_log_robot.y, 2.0);
  }
}

TEST(CarmenLog, KeepsWhatIsNoRangeAsNan) {
  const CarmenLog log = parse_carmen_log("FLASER 4 nan -1 x 2.0 0 0 0 0 0 0 1 host 1\n");
  ASSERT_EQ(log.scans[0].ranges_m.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isnan(log.scans[0].ranges_m[static_cast<std::size_t>(i)])) << i;
  }
  EXPECT_EQ(log.scans[0].ranges_m[3], 2.0F);
}

TEST(CarmenLog, SkipsMalformedLinesAndSaysWhichAndWhy) {
  const std::string good = "FLASER 2 1 1 0 0 0 0 0 0 1 host 1\n";
  for (const std::string bad :
       {"FLASER", "FLASER x 1 1 0 0 0 0 0 0 2 host 2", "FLASER -3 1 1 0 0 0 0 0 0 2 host 2",
        "FLASER 3 1 1 0 0 0 0 0 0 2", "FLASER 2.5 1 1 0 0 0 0 0 0 2 host 2",
        "FLASER 1 1 1 0 0 0 0 0 0 2 host 2", "FLASER 2 1 1 1 1 1 0 0 0 0 0 0 2 host 2",
        "FLASER 2 1 1 nan 0 0 0 0 0 2 host 2", "FLASER 999999999 1 1 0 0 0 0 0 0 2 host 2", "ODOM",
        "ODOM 1 2", "ODOM 1 2 zero 0 0 0 2 host 2", "ODOM inf 2 0 0 0 0 2 host 2"}) {
    SCOPED_TRACE(bad);
    const CarmenLog log = parse_carmen_log(good + bad + "\n");
    EXPECT_EQ(log.scans.size(), 1U);
    EXPECT_EQ(log.poses.size(), 1U);
    ASSERT_EQ(log.malformed.size(), 1U);
    EXPECT_EQ(log.malformed[0].line, 2U);
    EXPECT_THAT(log.malformed[0].text, HasSubstr(bad.substr(0, 4)));
  }
}

TEST(CarmenLog, WithoutAScanIsAnErrorThatSaysWhy) {
  EXPECT_THAT(message_of(""), HasSubstr("no usable FLASER line"));
  EXPECT_THAT(message_of("hello\nworld\n"), HasSubstr("is this a CARMEN log"));
  EXPECT_THAT(message_of("ODOM 0 0 0 0 0 0 1 host 1\n"), HasSubstr("no usable FLASER line"));
  EXPECT_THAT(message_of("\nFLASER 3 1 1\n"), HasSubstr("Line 2: FLASER"));
}

TEST(CarmenLog, MakesStampsStrictlyIncreasing) {
  std::string text = "FLASER 2 1 1 0 0 0 0 0 0 100 host 100\n";
  for (const char* stamp : {"100.5", "100.5", "107", "101", "3", "102", "102"}) {
    text += "ODOM 1 0 0 0 0 0 " + std::string{stamp} + " host 0\n";
  }
  text += "FLASER 2 1 1 1 0 0 1 0 0 102 host 102\n";
  const CarmenLog log = parse_carmen_log(text);
  ASSERT_EQ(log.poses.size(), 8U) << "the last odometry line and the scan are one";
  for (std::size_t i = 1; i < log.poses.size(); ++i) {
    EXPECT_GT(log.poses[i].stamp_s, log.poses[i - 1].stamp_s) << i;
  }
  EXPECT_EQ(log.moved_stamps, 4U) << "a repetition, one ahead, one behind, another repetition";
  EXPECT_LE(log.poses.back().stamp_s, 102.1) << "a stamp ahead of all does not push the others";
}

TEST(CarmenLog, AssumesTenHertzWhenTheStampsAreTooCoarse) {
  std::string text;
  for (int i = 0; i < 50; ++i) {
    text += "ODOM " + std::to_string(i) + " 0 0 0 0 0 1.01893e+09 host 1.01893e+09\n";
  }
  text += "FLASER 2 1 1 49 0 0 49 0 0 1.01893e+09 host 1.01893e+09\n";
  const CarmenLog log = parse_carmen_log(text);
  EXPECT_FALSE(log.has_clock);
  ASSERT_EQ(log.poses.size(), 50U);
  EXPECT_NEAR(log.poses.back().stamp_s - log.poses.front().stamp_s, 4.9, 1e-3);
}

TEST(CarmenLogFile, IsReadPlainAndCompressed) {
  const TempFile plain{"plain.log"};
  std::ofstream{plain.path()} << kSmallLog;
  const TempFile packed{"packed.log.gz"};
  gzFile file = gzopen(packed.path().c_str(), "wb");
  gzputs(file, kSmallLog);
  gzclose(file);
  for (const std::string& path : {plain.path(), packed.path()}) {
    SCOPED_TRACE(path);
    const CarmenLog log = read_carmen_log(path);
    EXPECT_EQ(log.poses.size(), 4U);
    EXPECT_EQ(log.scans.size(), 1U);
  }
}

TEST(CarmenLogFile, ThatIsMissingOrDamagedIsNamed) {
  const auto message = [](const std::string& path) {
    try {
      read_carmen_log(path);
    } catch (const std::runtime_error& e) {
      return std::string{e.what()};
    }
    return std::string{};
  };
  EXPECT_THAT(message("/no/such.log"), HasSubstr("/no/such.log: cannot be opened"));
  EXPECT_THAT(message("/"), HasSubstr("/: "));

  const TempFile torn{"torn.log.gz"};
  gzFile file = gzopen(torn.path().c_str(), "wb");
  for (int i = 0; i < 20000; ++i) {
    gzprintf(file, "ODOM %d %d 0 0 0 0 %d host 0\n", i * 7919 % 1013, i * 104729 % 997, i);
  }
  gzclose(file);
  std::filesystem::resize_file(torn.path(), std::filesystem::file_size(torn.path()) / 2);
  EXPECT_THAT(message(torn.path()), HasSubstr("damaged"));
}

/// The recorded data is not part of the package; where it is, every log must read well.
TEST(CarmenLogFile, OfTheRealBuildingsIsCleanAndPlausible) {
  const char* set = std::getenv("CMN_DATA_DIR");
  const std::filesystem::path data =
      set != nullptr ? std::filesystem::path{set}
                     : std::filesystem::path{CMN_SOURCE_DIR} / ".." / "shared" / "data";
  if (!std::filesystem::is_directory(data / "radish")) {
    GTEST_SKIP() << data << " has no radish/: set CMN_DATA_DIR to the folder of the recorded data";
  }
  for (const char* name : {"acapulco", "aces", "belgioioso", "fhw", "freiburg-079", "intel"}) {
    SCOPED_TRACE(name);
    const CarmenLog log = read_carmen_log((data / "radish" / name).string() + ".log.gz");
    EXPECT_TRUE(log.malformed.empty()) << log.malformed.front().text;
    EXPECT_GT(log.scans.size(), 390U);
    EXPECT_EQ(log.has_clock, std::string{name} != "belgioioso");
    for (std::size_t i = 1; i < log.poses.size(); ++i) {
      const Pose2 step = inverse(log.poses[i - 1].T_log_robot) * log.poses[i].T_log_robot;
      ASSERT_LT(norm(step.position()), 1.0) << i;
    }
  }
}

}  // namespace
}  // namespace cmn
