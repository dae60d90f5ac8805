// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Draws what a LiDAR, a depth camera, a panorama and both see of a room: depth_picture OUT.png.
#include "coarse_map_nav/perception/perception.hpp"

#include <cstdint>
#include <iostream>
#include <string>

#include "box_room.hpp"
#include "depth_images.hpp"
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr int kPanel = 360;  ///< [pixels]

/// White free, grey unseen, pale where only presumed, black occupied; the robot faces up.
cv::Mat panel_of(const LocalOccupancy& seen, const std::string& title) {
  cv::Mat cells(seen.size, seen.size, CV_8UC3);
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const std::size_t i = seen.index_of(ix, iy);
      const int grey = seen.confidence[i] == 0.0F        ? 170
                       : seen.occupancy[i] > 0.5F        ? 0
                       : seen.confidence[i] <= kPresumed ? 225
                                                         : 255;
      cells.at<cv::Vec3b>(seen.size - 1 - ix, seen.size - 1 - iy) =
          cv::Vec3b::all(static_cast<std::uint8_t>(grey));
    }
  }
  cv::Mat panel;
  cv::resize(cells, panel, {kPanel, kPanel}, 0.0, 0.0, cv::INTER_NEAREST);
  cv::circle(panel, {kPanel / 2, kPanel / 2}, 9, {200, 90, 20}, 2, cv::LINE_AA);
  cv::line(panel, {kPanel / 2, kPanel / 2}, {kPanel / 2, kPanel / 2 - 18}, {200, 90, 20}, 2,
           cv::LINE_AA);
  cv::copyMakeBorder(panel, panel, 28, 4, 4, 4, cv::BORDER_CONSTANT, cv::Scalar::all(255));
  cv::putText(panel, title, {8, 20}, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(0), 1,
              cv::LINE_AA);
  return panel;
}

DepthImage look(const Pose2& pose, std::uint32_t seed) {
  return noisy(depth_of_boxes(furnished_room(), CameraModel::from_field_of_view(640, 480, 1.518),
                              camera_mount(0.1, 0.55, 0.2), pose),
               seed);
}

PerceptionParams params_of(const std::string& source, const std::string& accumulate) {
  PerceptionParams params;
  params.source = source;
  params.accumulate = accumulate;
  params.local_occupancy = {140, 7.0, 0.0};
  return params;
}

int draw(const std::string& path) {
  const DepthImage ahead = look({}, 1);
  const RangeScan scan = scan_of_boxes(furnished_room(), 0.35, 720, {});
  Perception panorama{params_of("depth", "panorama")};
  Percept round;
  for (std::uint32_t turn = 0; turn <= 4; ++turn) {
    const Pose2 pose{0.0, 0.0, turn * kPi / 2.0};
    const DepthImage image = look(pose, turn);
    round = panorama.look({nullptr, &image}, pose, false);
  }
  cv::Mat picture;
  cv::hconcat(
      std::vector<cv::Mat>{
          panel_of(Perception{params_of("lidar", "none")}.look({&scan}, {}, false).seen,
                   "LiDAR at 0.35 m"),
          panel_of(Perception{params_of("depth", "none")}.look({nullptr, &ahead}, {}, false).seen,
                   "depth camera"),
          panel_of(round.seen, "depth panorama"),
          panel_of(Perception{params_of("fused", "none")}.look({&scan, &ahead}, {}, false).seen,
                   "LiDAR and depth camera")},
      picture);
  if (!cv::imwrite(path, picture)) {
    std::cerr << path << ": cannot be written\n";
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace cmn

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: depth_picture OUT.png\n";
    return 2;
  }
  return cmn::draw(argv[1]);
}
