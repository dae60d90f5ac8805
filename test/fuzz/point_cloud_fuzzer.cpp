// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any sensor_msgs/PointCloud2 -> local occupancy.
#include "coarse_map_nav/ros/camera_conversions.hpp"

#include "depth_check.hpp"

namespace cmn {

std::vector<std::string> fuzz_seeds() {
  std::vector<std::string> seeds;
  for (const bool is_double : {false, true}) {
    for (const std::uint32_t height : {1U, 8U}) {
      FuzzSeed seed;
      seed.put<std::int8_t>(8).put<std::int8_t>(25);
      const std::uint32_t width = 64 / height;
      const std::uint32_t point_step = is_double ? 32 : 16;
      seed.put(height).put(width).put(point_step).put(width * point_step);
      seed.put<std::uint8_t>(0).put<std::uint8_t>(3);
      std::uint32_t offset = 0;
      for (const char* name : {"x", "y", "z"}) {
        seed.put_word(name).put(offset);
        seed.put<std::uint8_t>(is_double ? sensor_msgs::PointField::FLOAT64
                                         : sensor_msgs::PointField::FLOAT32);
        seed.put<std::uint32_t>(1);
        offset += is_double ? 8 : 4;
      }
      for (int i = 0; i < 64; ++i) {
        for (const double value : {0.02 * (i % 8), 0.05 * (i / 8), 1.5, 0.0}) {
          is_double ? seed.put(value) : seed.put(static_cast<float>(value));
        }
      }
      seeds.push_back(seed.text());
    }
  }
  return seeds;
}

}  // namespace cmn

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cmn::FuzzInput input{data, size};
  const Eigen::Isometry3d mount = cmn::take_mount(input);
  sensor_msgs::PointCloud2 cloud;
  cloud.height = input.take<std::uint32_t>();
  cloud.width = input.take<std::uint32_t>();
  cloud.point_step = input.take<std::uint32_t>();
  cloud.row_step = input.take<std::uint32_t>();
  cloud.is_bigendian = input.take<std::uint8_t>();
  cloud.fields.resize(input.take<std::uint8_t>() % 8);
  for (sensor_msgs::PointField& field : cloud.fields) {
    field.name = input.take_word();
    field.offset = input.take<std::uint32_t>();
    field.datatype = input.take<std::uint8_t>();
    field.count = input.take<std::uint32_t>();
  }
  cloud.data = input.rest();
  std::string why;
  if (const auto view = cmn::view_of(cloud, mount, why)) {
    cmn::check(cmn::DepthProjector{cmn::coarse_bearings()}.scan(*view));
  } else {
    cmn::require(!why.empty(), "there is a reason");
  }
  return 0;
}
