// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/gif.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include <gif_lib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

cv::Mat filled(const cv::Scalar& bgr) { return cv::Mat(6, 8, CV_8UC3, bgr); }

/// The film as a viewer shows it: every stored part laid over what was there before.
std::vector<cv::Mat> shown(const std::string& path) {
  GifFileType* file = DGifOpenFileName(path.c_str(), nullptr);
  if (file == nullptr || DGifSlurp(file) != GIF_OK) {
    throw std::runtime_error("not a GIF");
  }
  std::vector<cv::Mat> frames;
  cv::Mat screen(file->SHeight, file->SWidth, CV_8UC3, cv::Scalar::all(0));
  for (int i = 0; i < file->ImageCount; ++i) {
    const SavedImage& image = file->SavedImages[i];
    GraphicsControlBlock control{};
    DGifSavedExtensionToGCB(file, i, &control);
    for (int k = 0; k < image.ImageDesc.Width * image.ImageDesc.Height; ++k) {
      const GifByteType index = image.RasterBits[k];
      if (index != control.TransparentColor) {
        const GifColorType& rgb = file->SColorMap->Colors[index];
        screen.at<cv::Vec3b>(image.ImageDesc.Top + k / image.ImageDesc.Width,
                             image.ImageDesc.Left + k % image.ImageDesc.Width) =
            cv::Vec3b(rgb.Blue, rgb.Green, rgb.Red);
      }
    }
    frames.push_back(screen.clone());
  }
  DGifCloseFile(file, nullptr);
  return frames;
}

TEST(Gif, ShowsTheFramesThatWentIn) {
  const std::string path = file_with("film.gif", "");
  std::vector<FilmFrame> film{{filled({250, 10, 20}), 0.1}, {filled({250, 10, 20}), 0.1}};
  film[1].picture.at<cv::Vec3b>(2, 3) = cv::Vec3b(0, 200, 90);
  film.push_back({film[1].picture.clone(), 0.1});
  film.push_back(film[0]);
  write_gif(path, film);
  const std::vector<cv::Mat> frames = shown(path);
  ASSERT_EQ(frames.size(), film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    EXPECT_EQ(cv::norm(frames[i], film[i].picture, cv::NORM_INF), 0.0) << "frame " << i;
  }
}

TEST(Gif, KeepsTheColoursMostUsedWhenThereAreTooMany) {
  const std::string path = file_with("film.gif", "");
  cv::Mat picture(120, 120, CV_8UC3, cv::Scalar(30, 60, 200));
  for (int i = 0; i < 1000; ++i) {  // 1000 colours, once each
    picture.at<cv::Vec3b>(i / 120, i % 120) =
        cv::Vec3b(static_cast<uchar>(25 * (i % 10)), static_cast<uchar>(25 * (i / 10 % 10)),
                  static_cast<uchar>(25 * (i / 100)));
  }
  write_gif(path, {{picture, 0.1}});
  const cv::Mat back = shown(path).at(0);
  EXPECT_EQ(back.at<cv::Vec3b>(100, 100), cv::Vec3b(30, 60, 200));
  EXPECT_LE(cv::norm(back, picture, cv::NORM_INF), 255.0);
  EXPECT_LT(cv::norm(back, picture, cv::NORM_L1) / static_cast<double>(picture.total() * 3), 5.0);
}

TEST(Gif, MayBeReadByOthers) {
  const std::string path = file_with("film.gif", "");
  std::filesystem::remove(path);
  write_gif(path, {{filled({1, 2, 3}), 0.1}});
  const std::string plain = file_with("plain.txt", "");
  EXPECT_EQ(std::filesystem::status(path).permissions(),
            std::filesystem::status(plain).permissions());
}

TEST(Gif, RefusesWhatIsNoFilm) {
  const std::string path = file_with("film.gif", "");
  EXPECT_THROW(write_gif(path, {}), std::invalid_argument);
  EXPECT_THROW(write_gif(path, {{cv::Mat{}, 0.1}}), std::invalid_argument);
  EXPECT_THROW(write_gif(path, {{cv::Mat(4, 4, CV_8UC1), 0.1}}), std::invalid_argument);
  EXPECT_THROW(write_gif(path, {{filled({}), 0.1}, {cv::Mat(4, 4, CV_8UC3), 0.1}}),
               std::invalid_argument);
  EXPECT_THAT(error_of([] {
                write_gif("/nowhere/film.gif", {{filled({}), 0.1}});
              }),
              ::testing::HasSubstr("/nowhere/film.gif"));
}

}  // namespace
}  // namespace cmn
