// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/contact_sheet.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace cmn {

cv::Mat contact_sheet(const std::vector<SketchStage>& stages, int columns) {
  constexpr int kWidth = 480;
  constexpr int kMargin = 16;
  constexpr int kCaption = 34;
  int height = 1;
  for (const SketchStage& stage : stages) {
    height = std::max(height, kWidth * stage.picture.rows / std::max(1, stage.picture.cols));
  }
  height = std::min(height, 2 * kWidth);
  const int rows = (static_cast<int>(stages.size()) + columns - 1) / columns;
  cv::Mat page(rows * (height + kCaption) + kMargin, columns * (kWidth + kMargin) + kMargin,
               CV_8UC3, cv::Scalar(236, 232, 228));
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const cv::Mat& picture = stages[i].picture;
    const double scale = std::min(static_cast<double>(kWidth) / picture.cols,
                                  static_cast<double>(height) / picture.rows);
    cv::Mat scaled;
    cv::resize(picture, scaled,
               {std::max(1, static_cast<int>(picture.cols * scale)),
                std::max(1, static_cast<int>(picture.rows * scale))},
               0, 0, scale > 1.0 ? cv::INTER_NEAREST : cv::INTER_AREA);
    cv::cvtColor(scaled, scaled, cv::COLOR_GRAY2BGR);
    const int x = kMargin + static_cast<int>(i) % columns * (kWidth + kMargin);
    const int y = static_cast<int>(i) / columns * (height + kCaption) + kCaption;
    scaled.copyTo(page(cv::Rect{{x, y}, scaled.size()}));
    cv::rectangle(page, cv::Rect{{x, y}, scaled.size()}, cv::Scalar(150, 140, 130));
    cv::putText(page, stages[i].caption, {x, y - 10}, cv::FONT_HERSHEY_SIMPLEX, 0.55,
                cv::Scalar(60, 45, 35), 1, cv::LINE_AA);
  }
  return page;
}

}  // namespace cmn
