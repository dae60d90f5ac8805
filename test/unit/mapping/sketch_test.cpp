// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/sketch.hpp"

#include "coarse_map_nav/mapping/contact_sheet.hpp"
#include "coarse_map_nav/mapping/frame.hpp"
#include "coarse_map_nav/mapping/image_reader.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

using ::testing::HasSubstr;

/// Free areas: 4-connected sets of free cells.
int count_rooms(const Grid<std::uint8_t>& occupied) {
  cv::Mat labels;
  return cv::connectedComponents(255 - image_of(occupied), labels, 4) - 1;
}

/// Obstacles that touch neither the rim nor what touches it, as their middles in shares of the free
/// space's box, from left to right and top to bottom.
std::vector<cv::Point2d> find_islands(const Grid<std::uint8_t>& occupied) {
  const cv::Mat image = image_of(occupied);
  const cv::Rect box = cv::boundingRect(255 - image);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(image, labels, stats, middles, 8, CV_32S);
  std::vector<cv::Point2d> islands;
  for (int i = 1; i < count; ++i) {
    const cv::Rect own{stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)};
    if (own.x > 0 && own.y > 0 && own.br().x < image.cols && own.br().y < image.rows) {
      islands.emplace_back((middles.at<double>(i, 0) - box.x) / box.width,
                           (middles.at<double>(i, 1) - box.y) / box.height);
    }
  }
  std::sort(islands.begin(), islands.end(), [](const auto& a, const auto& b) {
    return std::make_pair(cvRound(5.0 * a.x), a.y) < std::make_pair(cvRound(5.0 * b.x), b.y);
  });
  return islands;
}

/// Intersection over union of the free space of two pictures (255 = free) of the same plan, after
/// the registration (scale and shift along each axis) that makes it largest.
double overlap(const cv::Mat& free_a, const cv::Mat& free_b) {
  const cv::Size size{300, 200};
  cv::Mat a;
  cv::resize(free_a(cv::boundingRect(free_a)), a, size, 0, 0, cv::INTER_NEAREST);
  cv::copyMakeBorder(a, a, 20, 20, 20, 20, cv::BORDER_CONSTANT, 0);
  const cv::Mat b = free_b(cv::boundingRect(free_b));
  std::array<double, 4> at{static_cast<double>(size.width) / b.cols,
                           static_cast<double>(size.height) / b.rows, 20.0, 20.0};
  const auto score = [&](const std::array<double, 4>& t) {
    cv::Mat laid;
    const cv::Matx23d map{t[0], 0.0, t[2], 0.0, t[1], t[3]};
    cv::warpAffine(b, laid, map, a.size(), cv::INTER_NEAREST);
    return static_cast<double>(cv::countNonZero(a & laid)) / cv::countNonZero(a | laid);
  };
  double best = score(at);
  for (double step = 8.0; step >= 0.5; step /= 2.0) {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < 4; ++i) {
        for (const double sign : {-1.0, 1.0}) {
          std::array<double, 4> next = at;
          const double length = i == 0 ? b.cols : i == 1 ? b.rows : 1.0;
          next[i] += sign * step / length;
          const double value = score(next);
          if (value > best + 1e-9) {
            best = value;
            at = next;
            better = true;
          }
        }
      }
    }
  }
  return best;
}
double overlap(const Grid<std::uint8_t>& a, const Grid<std::uint8_t>& b) {
  return overlap(255 - image_of(a), 255 - image_of(b));
}

const cv::Scalar kInk{60, 35, 40};

/// A plan on paper: two rooms with a door of a cell and a half, a hatched table.
cv::Mat draw_plan() {
  cv::Mat paper{900, 1200, CV_8UC3, cv::Scalar{190, 225, 230}};
  cv::rectangle(paper, {200, 150}, {1000, 750}, kInk, 14);
  cv::line(paper, {600, 150}, {600, 400}, kInk, 10);
  cv::line(paper, {600, 460}, {600, 750}, kInk, 10);
  cv::rectangle(paper, {300, 300}, {460, 460}, kInk, 6);
  for (int k = 0; k < 320; k += 14) {  // hatching with paper between the strokes
    for (int t = 0; t < 160; ++t) {
      const cv::Point p{300 + t, 300 + k - t};
      if (p.y > 300 && p.y < 460) {
        cv::circle(paper, p, 3, kInk, -1);
      }
    }
  }
  return paper;
}

/// Uneven light, a desk at the left, punch holes, specks, noise, a turned or tilted view.
cv::Mat photograph(const cv::Mat& paper, const std::vector<cv::Point2f>& corners) {
  cv::Mat picture = paper.clone();
  for (const int x : {300, 600, 900}) {
    cv::circle(picture, {x, 60}, 12, cv::Scalar{120, 140, 150}, 3);
  }
  cv::putText(picture, "printed", {700, 100}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {90, 140, 60}, 1);
  cv::circle(picture, {800, 600}, 3, kInk, -1);
  picture.colRange(0, 60) = cv::Scalar{60, 90, 120};
  const std::vector<cv::Point2f> from{{200, 150}, {1000, 150}, {1000, 750}, {200, 750}};
  cv::warpPerspective(picture, picture, cv::getPerspectiveTransform(from, corners), picture.size(),
                      cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  std::mt19937 rng{7};
  std::normal_distribution<double> noise{0.0, 4.0};
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const double light = 0.5 + 0.5 * column / picture.cols * (0.6 + 0.4 * row / picture.rows);
      for (int i = 0; i < 3; ++i) {
        std::uint8_t& value = picture.at<cv::Vec3b>(row, column)[i];
        value = cv::saturate_cast<std::uint8_t>(light * value + noise(rng));
      }
    }
  }
  return picture;
}

SketchParams cells(int count) {
  SketchParams params;
  params.cells = count;
  return params;
}

void expect_plan(const cv::Mat& picture, const std::string& how) {
  const Sketch sketch = read_sketch(picture, cells(22));
  SCOPED_TRACE(ascii(sketch.occupied));
  EXPECT_EQ(count_rooms(sketch.occupied), 1);
  ASSERT_EQ(find_islands(sketch.occupied).size(), 1U);
  EXPECT_NEAR(sketch.occupied.height(), 17, 1);
  EXPECT_THAT(sketch.stages[sketch.stages.size() - 3].caption, HasSubstr(how));
  const Sketch clean = read_sketch(draw_plan(), cells(22));
  EXPECT_GT(overlap(sketch.occupied, clean.occupied), 0.93);
  // The wall stands, but for the door: the first row of the interior is cut in two.
  int walls = 0;
  for (int x = 1; x + 1 < sketch.occupied.width(); ++x) {
    walls += sketch.occupied({x, sketch.occupied.height() - 3});
  }
  EXPECT_GE(walls, 1);
}

TEST(Sketch, ReadsAPhotoThatLiesStraight) {
  expect_plan(photograph(draw_plan(), {{200, 150}, {1000, 150}, {1000, 750}, {200, 750}}), "none");
}

TEST(Sketch, LaysATurnedPhotoStraight) {
  expect_plan(photograph(draw_plan(), {{231, 123}, {1027, 206}, {965, 803}, {169, 719}}),
              "perspective");
}

TEST(Sketch, LaysATiltedPhotoStraight) {
  expect_plan(photograph(draw_plan(), {{260, 190}, {940, 160}, {1010, 760}, {190, 740}}),
              "perspective");
}

TEST(Sketch, FindsTheDirectionOfWallsWhateverTheOutline) {
  for (const double degrees : {-30.0, -4.0, 0.0, 2.0, 17.0, 44.0}) {
    SCOPED_TRACE(degrees);
    cv::Mat ink = cv::Mat::zeros(800, 800, CV_8UC1);
    const std::vector<cv::Point> outline{{250, 250}, {550, 250}, {550, 400},
                                         {400, 400}, {400, 600}, {250, 600}};
    cv::polylines(ink, outline, true, 255, 12);
    const cv::Mat turn = cv::getRotationMatrix2D({400, 400}, -degrees, 1.0);  // y down
    cv::warpAffine(ink, ink, turn, ink.size());
    ink = ink > 127;
    EXPECT_NEAR(wall_direction(ink) * 180.0 / kPi, degrees, 0.5);
    const Straightened straight = straighten(ink, cv::boundingRect(ink));
    EXPECT_NEAR(wall_direction(straight.ink) * 180.0 / kPi, 0.0, 1.0) << straight.how;
  }
}

TEST(Sketch, LeavesAMapOfOnePixelACellAsItIs) {
  cv::Mat map{30, 50, CV_8UC1, cv::Scalar{255}};
  map.row(0) = 0;
  map.col(49) = 0;
  map(cv::Rect{10, 10, 5, 3}) = 0;
  EXPECT_EQ(read_sketch(map, cells(50)).occupied, grid_of(255 - map));
}

TEST(Sketch, CutsTheMarginOffADrawingWithADoorInItsOuterWall) {
  cv::Mat paper = draw_plan();
  cv::line(paper, {200, 500}, {200, 560}, cv::Scalar{190, 225, 230}, 20);
  const Sketch sketch = read_sketch(paper, cells(22));
  EXPECT_EQ(count_rooms(sketch.occupied), 1) << ascii(sketch.occupied);
  EXPECT_GT(overlap(sketch.occupied, read_sketch(draw_plan(), cells(22)).occupied), 0.85)
      << ascii(sketch.occupied);
}

TEST(Sketch, ObeysAGivenThreshold) {
  cv::Mat paper = draw_plan();
  cv::rectangle(paper, {700, 300}, {860, 460}, cv::Scalar{140, 150, 150}, -1);  // pencil
  SketchParams params = cells(22);
  params.threshold = 0.35;
  EXPECT_EQ(find_islands(read_sketch(paper, params).occupied).size(), 1U);
  params.threshold = 0.8;
  EXPECT_EQ(find_islands(read_sketch(paper, params).occupied).size(), 2U);
}

TEST(Sketch, SaysWhyAPictureIsNoDrawing) {
  const auto problem = [](const cv::Mat& picture, int count) {
    return error_of([&] { read_sketch(picture, cells(count)); });
  };
  EXPECT_THAT(problem({}, 50), HasSubstr("empty"));
  EXPECT_THAT(problem(cv::Mat(100, 100, CV_8UC1, cv::Scalar(255)), 50), HasSubstr("no drawing"));
  EXPECT_THAT(problem(cv::Mat(100, 100, CV_8UC1, cv::Scalar(0)), 50), HasSubstr("free"));
  cv::Mat small{10, 10, CV_8UC1, cv::Scalar{255}};
  small.row(0) = 0;
  EXPECT_THAT(problem(small, 50), HasSubstr("fewer cells"));
}

TEST(Sketch, ShowsEveryStageOnOnePage) {
  const Sketch sketch = read_sketch(draw_plan(), cells(22));
  EXPECT_GE(sketch.stages.size(), 4U);
  EXPECT_EQ(contact_sheet(sketch.stages).type(), CV_8UC3);
  EXPECT_GT(contact_sheet(sketch.stages).cols, contact_sheet(sketch.stages, 1).cols);
}

TEST(Sketch, ReadsRobbsPhotoAsItsAuthorDid) {
  const std::string photo = data_file("robb/hand_drawn_map.JPG");
  const std::string drawn = data_file("robb/exp120_v1.png");
  CMN_NEEDS_DATA(photo);
  CMN_NEEDS_DATA(drawn);
  const Sketch sketch = read_sketch(read_colour_image(photo), cells(50));
  const Grid<std::uint8_t>& ours = sketch.occupied;
  const Grid<std::uint8_t> authors = read_map(drawn).occupied();
  SCOPED_TRACE(ascii(ours));
  EXPECT_EQ(ours.width(), 50);
  EXPECT_NEAR(ours.height(), authors.height(), 2);
  EXPECT_EQ(count_rooms(ours), count_rooms(authors));
  const auto our_islands = find_islands(ours);
  const auto authors_islands = find_islands(authors);
  ASSERT_EQ(our_islands.size(), authors_islands.size());
  for (std::size_t i = 0; i < our_islands.size(); ++i) {
    EXPECT_LT(cv::norm(our_islands[i] - authors_islands[i]), 0.08) << "island " << i;
  }
  // The author redrew the furniture by hand, so that even the straightened photo itself agrees with
  // his map only so far; our cells must agree as well as that.
  const double iou = overlap(ours, authors);
  const double iou_of_photo =
      overlap(sketch.stages[sketch.stages.size() - 2].picture, 255 - image_of(authors));
  RecordProperty("iou_permille", static_cast<int>(1000.0 * iou));
  RecordProperty("iou_of_photo_permille", static_cast<int>(1000.0 * iou_of_photo));
  EXPECT_GT(iou, 0.75);
  EXPECT_GT(iou, iou_of_photo - 0.03);
  const std::string thresholded = data_file("robb/hand_drawn_map_thresholded.png");
  CMN_NEEDS_DATA(thresholded);
  const double iou_of_thresholded = overlap(ours, read_map(thresholded).occupied());
  RecordProperty("iou_thresholded_permille", static_cast<int>(1000.0 * iou_of_thresholded));
  EXPECT_GT(iou_of_thresholded, 0.85);
}

}  // namespace
}  // namespace cmn
