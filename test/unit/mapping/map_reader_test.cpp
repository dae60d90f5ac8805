// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/map_reader.hpp"

#include "coarse_map_nav/mapping/map_writer.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace cmn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kGoodKeys =
    "resolution: 0.5\norigin: [1, 2, 0.25]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

std::string image_file(const std::string& name, const cv::Mat& pixels) {
  const std::string path = file_with(name, "");
  cv::imwrite(path, pixels);
  return path;
}

/// A map_server map whose image lies beside it.
CoarseMap read_with(const cv::Mat& pixels, const std::string& keys) {
  const std::string image = image_file("image.png", pixels);
  return read_map(
      file_with("map.yaml", "image: " + image.substr(image.find_last_of('/') + 1) + "\n" + keys));
}

cv::Mat row_of(std::initializer_list<std::uint8_t> pixels) {
  return cv::Mat(std::vector<std::uint8_t>(pixels), true).reshape(1, 1);
}

std::string ascii(const CoarseMap& map) {
  std::string text;
  for (int y = map.height(); y-- > 0;) {
    for (int x = 0; x < map.width(); ++x) {
      text += map.is_free({x, y}) ? '.' : '#';
    }
    text += '\n';
  }
  return text;
}

TEST(MapReader, ReadsAllKeysOfMapServer) {
  cv::Mat pixels{2, 3, CV_8UC1, cv::Scalar{255}};
  pixels.at<std::uint8_t>(0, 2) = 0;
  const CoarseMap map = read_with(pixels, kGoodKeys);
  EXPECT_EQ(ascii(map),
            "..#\n"
            "...\n");
  EXPECT_EQ(map.resolution(), 0.5);
  EXPECT_EQ(map.T_map_grid().x, 1.0);
  EXPECT_EQ(map.T_map_grid().y, 2.0);
  EXPECT_EQ(map.T_map_grid().yaw, 0.25);
  EXPECT_EQ(map.free_count(), 5U);
}

TEST(MapReader, TakesUnknownAsOccupied) {
  EXPECT_EQ(ascii(read_with(row_of({0, 100, 205, 206, 254}), kGoodKeys)), "###..\n");
}

TEST(MapReader, NegatesOnRequest) {
  for (const std::string word : {"1", "true"}) {
    std::string keys = kGoodKeys;
    keys.replace(keys.find("negate: 0"), 9, "negate: " + word);
    EXPECT_EQ(ascii(read_with(row_of({0, 40, 60, 255}), keys)), "..##\n");
  }
}

TEST(MapReader, KnowsTheModes) {
  const cv::Mat pixels = row_of({0, 10, 50, 100, 255});
  EXPECT_EQ(ascii(read_with(pixels, kGoodKeys + "mode: raw\n")), "..###\n");
  EXPECT_EQ(ascii(read_with(pixels, kGoodKeys + "mode: scale\n")), "####.\n");
  EXPECT_EQ(ascii(read_with(pixels, kGoodKeys + "mode: trinary\n")), "####.\n");
}

TEST(MapReader, LaysTransparencyOverWhiteButModeScaleCallsItUnknown) {
  cv::Mat pixels{1, 3, CV_8UC4, cv::Scalar{0, 0, 0, 0}};
  pixels.at<cv::Vec4b>(0, 1) = {0, 0, 0, 255};
  pixels.at<cv::Vec4b>(0, 2) = {255, 255, 255, 255};
  EXPECT_EQ(ascii(read_with(pixels, kGoodKeys)), ".#.\n");
  EXPECT_EQ(ascii(read_with(pixels, kGoodKeys + "mode: scale\n")), "##.\n");
}

TEST(MapReader, ReadsSixteenBitAndColour) {
  cv::Mat deep{1, 2, CV_16UC1, cv::Scalar{65535}};
  deep.at<std::uint16_t>(0, 0) = 300;
  EXPECT_EQ(ascii(read_map(image_file("deep.png", deep))), "#.\n");
  cv::Mat colour{1, 2, CV_8UC3, cv::Scalar{200, 255, 255}};
  colour.at<cv::Vec3b>(0, 0) = {90, 20, 20};
  EXPECT_EQ(ascii(read_map(image_file("colour.png", colour))), "#.\n");
  cv::Mat deep_alpha{1, 2, CV_16UC4, cv::Scalar{0, 0, 0, 65535}};
  deep_alpha.at<cv::Vec4w>(0, 1) = {0, 0, 0, 0};
  EXPECT_EQ(ascii(read_map(image_file("deep_alpha.png", deep_alpha))), "#.\n");
}

TEST(MapReader, GivesAPlainImageTheWantedResolution) {
  EXPECT_EQ(read_map(image_file("plain.png", row_of({0, 255})), 0.3).resolution(), 0.3);
  EXPECT_THAT(error_of([] { read_map("any.png", 0.0); }), HasSubstr("resolution"));
  EXPECT_THAT(error_of([] { read_map("any.png", std::nan("")); }), HasSubstr("resolution"));
}

TEST(MapReader, ListsEveryFaultyKeyAtOnce) {
  const std::string path = file_with("map.yaml",
                                     "resolution: -1\norigin: [0, .nan, 0]\nnegate: 7\n"
                                     "occupied_thresh: 65\nmode: gray\n");
  EXPECT_THAT(
      error_of([&] { read_map(path); }),
      AllOf(HasSubstr(path), HasSubstr("image is missing"), HasSubstr("resolution must"),
            HasSubstr("origin must"), HasSubstr("negate must"), HasSubstr("occupied_thresh must"),
            HasSubstr("free_thresh is missing"), HasSubstr("mode must")));
}

TEST(MapReader, RejectsThresholdsThatCross) {
  EXPECT_THAT(error_of([] {
                read_with(row_of({255}),
                          "resolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
                          "occupied_thresh: 0.2\nfree_thresh: 0.6\n");
              }),
              HasSubstr("free_thresh must not be above occupied_thresh"));
}

TEST(MapReader, NamesFilesThatCannotBeRead) {
  for (const std::string path : {"/nowhere/map.yaml", "/nowhere/map.png", "/nowhere/map.npy"}) {
    EXPECT_THAT(error_of([&] { read_map(path); }), HasSubstr(path));
  }
  EXPECT_THAT(error_of([] { read_map(file_with("no.png", "this is text")); }),
              HasSubstr("is not an image"));
  EXPECT_THAT(error_of([] { read_map(file_with("no.yaml", "a: [1, 2")); }), HasSubstr("not YAML"));
  EXPECT_THAT(error_of([] { read_map(file_with("empty.yaml", "")); }), HasSubstr("holds no keys"));
  EXPECT_THAT(error_of([] { read_map(file_with("m.yaml", "image: gone.png\n" + kGoodKeys)); }),
              HasSubstr("gone.png"));
  EXPECT_THAT(error_of([] { read_map(::testing::TempDir()); }), HasSubstr(::testing::TempDir()));
}

TEST(MapReader, RefusesAMapWithoutFreeCells) {
  EXPECT_THAT(error_of([] {
                read_map(image_file("black.png", row_of({0, 0})));
              }),
              HasSubstr("no free cell"));
}

TEST(MapReader, IgnoresTheBlocksOfPlaces) {
  EXPECT_NO_THROW(read_with(row_of({255}), kGoodKeys + "places: {}\ndefault_goal: x\n"));
}

TEST(MapReader, ReadsALargeWorld) {
  const std::string path = image_file("world.png", cv::Mat{1200, 2000, CV_8UC1, cv::Scalar{255}});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(read_map(path).free_count(), 2'400'000U);
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  RecordProperty("milliseconds", static_cast<int>(1e3 * duration.count()));
}

TEST(MapReader, PutsRowsAndColumnsAtTheirMetres) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const int rows = 1 + static_cast<int>(rng() % 12);
    const int columns = 1 + static_cast<int>(rng() % 12);
    const int row = static_cast<int>(rng() % static_cast<unsigned>(rows));
    const int column = static_cast<int>(rng() % static_cast<unsigned>(columns));
    cv::Mat pixels{rows, columns, CV_8UC1, cv::Scalar{0}};
    pixels.at<std::uint8_t>(row, column) = 255;
    const CoarseMap map = read_with(pixels, kGoodKeys);
    // map_server: the outer corner of the lower left pixel is the origin, rows count downwards.
    const Point2 p_grid{(column + 0.5) * 0.5, (rows - row - 0.5) * 0.5};
    const Point2 p_map = Pose2{1.0, 2.0, 0.25} * p_grid;
    EXPECT_TRUE(map.is_free(map.cell_of(p_map)));
    EXPECT_EQ(map.free_count(), 1U);
    EXPECT_NEAR(norm(map.center_of(map.cell_of(p_map)) - p_map), 0.0, 1e-12);
  }
}

TEST(MapWriter, WritesWhatTheReaderReads) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    Grid<std::uint8_t> occupied{1 + static_cast<int>(rng() % 20), 1 + static_cast<int>(rng() % 20)};
    for (std::uint8_t& cell : occupied.values()) {
      cell = rng() % 2;
    }
    occupied[0] = 0;
    const double resolution = 0.05 + static_cast<double>(rng() % 100) / 70.0;
    const CoarseMap map{occupied, resolution, {static_cast<double>(rng() % 9) / 7.0, -0.1, 0.3}};
    const std::string path = file_with("map.yaml", "");
    write_map(path, map);
    const CoarseMap back = read_map(path);
    EXPECT_EQ(back.occupied(), map.occupied());
    EXPECT_EQ(back.resolution(), map.resolution());
    EXPECT_EQ(back.T_map_grid().x, map.T_map_grid().x);
    EXPECT_EQ(back.T_map_grid().yaw, map.T_map_grid().yaw);
  }
}

TEST(MapWriter, NamesAFileThatCannotBeWritten) {
  const CoarseMap map{Grid<std::uint8_t>{2, 2}, 1.0};
  EXPECT_THAT(error_of([&] { write_map("/nowhere/map.yaml", map); }),
              HasSubstr("/nowhere/map.png"));
  EXPECT_THAT(error_of([&] { write_map("map.png", map); }), HasSubstr("ends in .yaml"));
  EXPECT_THAT(error_of([] { write_map(file_with("m.yaml", ""), CoarseMap{}); }),
              HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace cmn
