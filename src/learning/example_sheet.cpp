// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_sheet.hpp"

#include <functional>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr int kSide = 128;  ///< of every picture [pixels]
constexpr int kGap = 4;

/// A square of cells with forward up: `occupied` and `seen` in [0, 1] by (ix, iy).
cv::Mat square_picture(int size,
                       const std::function<cv::Vec2f(int ix, int iy)>& occupied_and_seen) {
  cv::Mat cells(size, size, CV_8UC3);
  for (int iy = 0; iy < size; ++iy) {
    for (int ix = 0; ix < size; ++ix) {
      const cv::Vec2f value = occupied_and_seen(ix, iy);
      const float bright = 255.0F * (1.0F - value[0]);
      const cv::Vec3f yellow{70.0F, 190.0F, 220.0F};
      const cv::Vec3f shade = value[1] * cv::Vec3f::all(bright) +
                              (1.0F - value[1]) * (0.75F * yellow + 0.25F * cv::Vec3f::all(bright));
      cells.at<cv::Vec3b>(size - 1 - ix, size - 1 - iy) = shade;
    }
  }
  cv::Mat picture;
  cv::resize(cells, picture, {kSide, kSide}, 0.0, 0.0, cv::INTER_NEAREST);
  return picture;
}

cv::Mat truth_picture(const cv::Mat& truth) {
  return square_picture(truth.cols, [&](int ix, int iy) {
    const std::uint8_t cell = truth.at<std::uint8_t>(iy, ix);
    return cv::Vec2f{(cell & kTruthOccupied) != 0 ? 1.0F : 0.0F,
                     (cell & kTruthSeen) != 0 ? 1.0F : 0.0F};
  });
}

cv::Mat predicted_picture(const LocalOccupancy& predicted) {
  return square_picture(predicted.size, [&](int ix, int iy) {
    const std::size_t i = predicted.index_of(ix, iy);
    return cv::Vec2f{predicted.occupancy[i], predicted.confidence[i]};
  });
}

std::vector<cv::Mat> pictures_of(const SheetRow& row) {
  std::vector<cv::Mat> pictures;
  for (const std::size_t k : {1U, 0U, 3U, 2U}) {
    cv::Mat view;
    cv::resize(row.panorama.views[k], view, {kSide, kSide}, 0.0, 0.0, cv::INTER_CUBIC);
    pictures.push_back(view);
  }
  if (row.truth) {
    pictures.push_back(truth_picture(row.truth->near));
  }
  if (row.predicted) {
    pictures.push_back(predicted_picture(row.predicted->near));
  }
  if (row.truth) {
    pictures.push_back(truth_picture(row.truth->wide));
  }
  if (row.predicted && row.predicted->wide) {
    pictures.push_back(predicted_picture(*row.predicted->wide));
  }
  return pictures;
}

}  // namespace

cv::Mat example_sheet(const std::vector<SheetRow>& rows) {
  cv::Mat sheet;
  for (const SheetRow& row : rows) {
    cv::Mat line;
    for (const cv::Mat& picture : pictures_of(row)) {
      cv::Mat framed;
      cv::copyMakeBorder(picture, framed, kGap, 0, kGap, 0, cv::BORDER_CONSTANT,
                         cv::Scalar::all(255));
      line = line.empty() ? framed : (cv::hconcat(line, framed, line), line);
    }
    sheet = sheet.empty() ? line : (cv::vconcat(sheet, line, sheet), sheet);
  }
  return sheet;
}

}  // namespace cmn
