// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a depth camera costs: an image or cloud of 640 x 480 to local occupancy, and the same with
/// the plain pipeline of PCL.
#include "coarse_map_nav/perception/depth_projection.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <cstdint>
#include <cstring>
#include <vector>

#include "box_room.hpp"
#include "depth_images.hpp"
#ifdef CMN_PCL
#include "depth_reference.hpp"
#endif
#include <benchmark/benchmark.h>

namespace cmn {
namespace {

const ProjectionParams kGrid{160, 16.0, 0.0};

const DepthImage& room_image() {
  static const DepthImage kImage =
      noisy(depth_of_boxes(furnished_room(), CameraModel::from_field_of_view(640, 480, 1.518),
                           camera_mount(0.1, 0.55, 0.2), {}),
            1);
  return kImage;
}

void image_to_occupancy(benchmark::State& state) {
  DepthProjector projector{DepthParams{}};
  RangeProjector to_grid{kGrid};
  for (auto _ : state) {
    benchmark::DoNotOptimize(to_grid.project(projector.scan(room_image())));
  }
}
BENCHMARK(image_to_occupancy)->Unit(benchmark::kMillisecond);

/// 307 200 points of `point_step` bytes.
void cloud_to_occupancy(benchmark::State& state, std::size_t point_step, bool is_organised) {
  const std::vector<std::uint8_t> bytes = cloud_bytes_of(room_image(), point_step);
  const PointCloudView cloud = view_of(bytes, room_image(), point_step, is_organised);
  DepthProjector projector{DepthParams{}};
  RangeProjector to_grid{kGrid};
  for (auto _ : state) {
    benchmark::DoNotOptimize(to_grid.project(projector.scan(cloud)));
  }
}
BENCHMARK_CAPTURE(cloud_to_occupancy, xyz, 16, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cloud_to_occupancy, xyzrgb, 32, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cloud_to_occupancy, loose, 16, false)->Unit(benchmark::kMillisecond);

#ifdef CMN_PCL
/// The same bytes to the same grid: read, VoxelGrid, PassThrough (and StatisticalOutlierRemoval)
/// and a line for every point. Counts the share of cells seen by both in which they agree.
void plain_pcl(benchmark::State& state) {
  const auto point_step = static_cast<std::size_t>(state.range(0));
  const ReferenceParams how{0.01 * static_cast<double>(state.range(1)), state.range(2) != 0};
  const DepthImage& image = room_image();
  const pcl::PCLPointCloud2 message = pcl_message_of(image, point_step);
  ReferencePipeline reference{DepthParams{}, kGrid, how};
  LocalOccupancy theirs;
  for (auto _ : state) {
    theirs = reference.project(message, image.T_robot_camera);
    benchmark::DoNotOptimize(theirs);
  }
  DepthProjector projector{DepthParams{}};
  const Comparison compared = compare(
      RangeProjector{kGrid}.project(projector.scan(view_of(message.data, image, point_step, true))),
      theirs);
  state.counters["cells"] = compared.both;
  state.counters["agree"] = compared.agreement();
}
BENCHMARK(plain_pcl)
    ->ArgsProduct({{16, 32}, {3, 10}, {0}})
    ->Args({32, 3, 1})
    ->ArgNames({"bytes", "leaf_cm", "outliers"})
    ->Unit(benchmark::kMillisecond);
#endif

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
