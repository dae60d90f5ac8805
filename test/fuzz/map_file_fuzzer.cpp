// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any file that a map may come in: map_server yaml with an image beside it, image alone, .npy.
#include "coarse_map_nav/mapping/map_reader.hpp"

#include <stdexcept>

#include "fuzz_files.hpp"
#include "fuzz_input.hpp"

namespace cmn {
namespace {

const std::string kImage = "P5\n3 2\n255\n" + std::string("\xff\x00\xff\x80\xff\xff", 6);
const std::string kKeys =
    "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

}  // namespace

std::vector<std::string> fuzz_seeds() {
  const std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }\n";
  const std::string npy = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) +
                          std::string(1, '\0') + header + std::string(6, '\0');
  return {std::string(1, '\0') + kKeys + "mode: scale\n", "\1" + kImage, "\2" + npy, "\3" + kImage};
}

}  // namespace cmn

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  static const cmn::FuzzFolder folder;
  const std::string content{reinterpret_cast<const char*>(data) + 1, size - 1};
  std::string path;
  switch (data[0] % 4) {
    case 0:
      folder.write("map.pgm", cmn::kImage);
      path = folder.write("map.yaml", content);
      break;
    case 1:
      folder.write("map.pgm", content);
      path = folder.write("map.yaml", cmn::kKeys);
      break;
    case 2:
      path = folder.write("map.npy", content);
      break;
    default:
      path = folder.write("map.png", content);
  }
  try {
    const cmn::CoarseMap map = cmn::read_map(path);
    cmn::require(map.free_count() > 0, "a map has a free cell");
    cmn::require(map.resolution() > 0.0, "cells have a size");
  } catch (const std::runtime_error& e) {
    cmn::require(std::string{e.what()}.find(": ") != std::string::npos, "errors say where");
  }
  return 0;
}
