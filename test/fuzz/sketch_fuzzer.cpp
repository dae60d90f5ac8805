// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any small picture -> cells of a drawing.
#include "coarse_map_nav/mapping/sketch.hpp"

#include <algorithm>
#include <stdexcept>

#include "fuzz_input.hpp"

namespace cmn {

std::vector<std::string> fuzz_seeds() {
  FuzzSeed room;  // a room with a door, a pixel of ink thick
  room.put<std::uint8_t>(40).put<std::uint8_t>(40).put<std::uint8_t>(8).put<std::uint8_t>(0);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const bool is_wall = x < 5 || y < 5 || x > 34 || y > 34;
      const bool is_door = x > 34 && y > 15 && y < 25;
      room.put<std::uint8_t>(is_wall && !is_door ? 0 : 255);
    }
  }
  return {room.text()};
}

}  // namespace cmn

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cmn::FuzzInput input{data, size};
  const int width = 1 + input.take<std::uint8_t>() % 96;
  const int height = 1 + input.take<std::uint8_t>() % 96;
  cmn::SketchParams params;
  params.cells = 2 + input.take<std::uint8_t>() % 64;
  cv::Mat picture(height, width, input.take<std::uint8_t>() % 2 == 0 ? CV_8UC1 : CV_8UC3);
  picture = cv::Scalar::all(255);
  const std::vector<std::uint8_t> bytes = input.rest();
  std::copy_n(bytes.begin(), std::min(bytes.size(), picture.total() * picture.elemSize()),
              picture.data);
  try {
    const cmn::Sketch sketch = cmn::read_sketch(picture, params);
    const auto& cells = sketch.occupied.values();
    cmn::require(std::count(cells.begin(), cells.end(), 0) > 0, "a drawing has a free cell");
  } catch (const std::runtime_error& e) {
    cmn::require(!std::string{e.what()}.empty(), "there is a reason");
  }
  return 0;
}
