// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any sensor_msgs/Image with any sensor_msgs/CameraInfo -> local occupancy.
#include "coarse_map_nav/ros/camera_conversions.hpp"

#include "depth_check.hpp"

namespace cmn {

std::vector<std::string> fuzz_seeds() {
  std::vector<std::string> seeds;
  for (const bool is_mm : {true, false}) {
    FuzzSeed seed;
    constexpr std::uint32_t kSide = 16;
    seed.put<std::int8_t>(8).put<std::int8_t>(25);
    seed.put(kSide).put(kSide);
    for (const double k : {8.0, 8.0, 7.5, 7.5}) {
      seed.put(k);
    }
    seed.put(kSide).put(kSide).put<std::uint32_t>(kSide * (is_mm ? 2 : 4));
    seed.put<std::uint8_t>(0).put_word(is_mm ? "16UC1" : "32FC1");
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      is_mm ? seed.put<std::uint16_t>(static_cast<std::uint16_t>(1000 + 10 * i))
            : seed.put(1.0F + 0.01F * static_cast<float>(i));
    }
    seeds.push_back(seed.text());
  }
  return seeds;
}

}  // namespace cmn

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cmn::FuzzInput input{data, size};
  const Eigen::Isometry3d mount = cmn::take_mount(input);
  sensor_msgs::CameraInfo info;
  info.width = input.take<std::uint32_t>();
  info.height = input.take<std::uint32_t>();
  for (const std::size_t i : {0U, 4U, 2U, 5U}) {
    info.K[i] = input.take<double>();
  }
  sensor_msgs::Image image;
  image.width = input.take<std::uint32_t>();
  image.height = input.take<std::uint32_t>();
  image.step = input.take<std::uint32_t>();
  image.is_bigendian = input.take<std::uint8_t>();
  image.encoding = input.take_word();
  image.data = input.rest();
  std::string why;
  const auto camera = cmn::camera_of(info, why);
  const auto depth = camera ? cmn::depth_of(image, *camera, mount, why) : std::nullopt;
  if (depth) {
    cmn::check(cmn::DepthProjector{cmn::coarse_bearings()}.scan(*depth));
  } else {
    cmn::require(!why.empty(), "there is a reason");
  }
  return 0;
}
