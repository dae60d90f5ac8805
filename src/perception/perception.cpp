// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/perception.hpp"

#include "coarse_map_nav/perception/grown.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

namespace cmn {
namespace {

class SingleLooks : public Accumulator {
 public:
  LocalOccupancy fuse(LocalOccupancy look, const Pose2& /*T_odom_robot*/) override { return look; }
  void forget() override {}
};

/// In its plane a LiDAR sees the ground to be free; a seat may stand below that, and a table's top
/// above.
void presume_free(LocalOccupancy& of_plane) {
  for (std::size_t i = 0; i < of_plane.cell_count(); ++i) {
    if (of_plane.occupancy[i] <= 0.5F) {
      of_plane.confidence[i] = std::min(of_plane.confidence[i], kPresumed);
    }
  }
}

}  // namespace

std::unique_ptr<Accumulator> make_accumulator(const std::string& word,
                                              const PerceptionParams& params) {
  if (word == "none") {
    return std::make_unique<SingleLooks>();
  }
  if (word == "panorama") {
    if (params.uses_color()) {  // what is collected are the images
      return std::make_unique<SingleLooks>();
    }
    return std::make_unique<Panorama>(params.panorama);
  }
  if (word == "rolling") {
    return std::make_unique<RollingMap>(params.rolling);
  }
  throw std::invalid_argument("perception/accumulate \"" + word +
                              "\" is none of none, panorama, rolling");
}

LocalOccupancy nearest_of(const LocalOccupancy& a, const LocalOccupancy& b) {
  assert(a.size == b.size && a.resolution == b.resolution);
  LocalOccupancy all = a;
  all.source = ObservationSource::kFused;
  for (std::size_t i = 0; i < all.cell_count(); ++i) {
    // Obstacles count more than what lies behind them, that more than free ground.
    const auto weight = [i](const LocalOccupancy& seen) {
      return (seen.occupancy[i] > 0.5F ? 2.0F : 0.0F) + seen.confidence[i];
    };
    if (weight(b) > weight(a)) {
      all.occupancy[i] = b.occupancy[i];
      all.confidence[i] = b.confidence[i];
    }
  }
  return all;
}

Perception::View::View(const PerceptionParams& params, const ProjectionParams& grid,
                       const std::string& accumulate)
    : projector{grid}, camera_projector{grid}, accumulator{make_accumulator(accumulate, params)} {}

Perception::Perception(const PerceptionParams& params,
                       std::shared_ptr<OccupancyPredictor> predictor)
    : params_{params},
      depth_{params.depth},
      predictor_{std::move(predictor)},
      color_looks_{params.accumulate == "panorama"},
      seen_{params, with_margin(params.local_occupancy, params.grow_m), params.accumulate},
      local_map_{
          params, params.local_map,
          params.accumulate_local_map == "same" ? params.accumulate : params.accumulate_local_map} {
  if (params.uses_color() && predictor_ == nullptr) {
    throw std::invalid_argument(
        "perception/source is rgb, but there is no network to predict with");
  }
}

RangeScan Perception::depth_scan(const SensorData& data) {
  assert(data.image != nullptr || data.cloud != nullptr);
  return data.image != nullptr ? depth_.scan(*data.image) : depth_.scan(*data.cloud);
}

RangeScan Perception::camera_scan(const SensorData& data, const Pose2& T_odom_robot) {
  if (!params_.uses_color()) {
    return params_.uses_depth() ? depth_scan(data) : RangeScan{};
  }
  assert(data.color != nullptr);
  const ColorPanorama panorama = color_looks_.add(*data.color, T_odom_robot);
  if (color_looks_.is_complete()) {
    return predicted_scan(predictor_->predict(panorama), panorama, params_.rgb);
  }
  RangeScan nothing;  // nobody concludes anything from a part: not worth a prediction
  nothing.stamp_s = panorama.stamp_s;
  nothing.source = ObservationSource::kRgb;
  return nothing;
}

Percept Perception::look(const SensorData& data, const Pose2& T_odom_robot, bool with_local_map) {
  assert(data.scan != nullptr || !params_.uses_scan());
  const RangeScan of_camera = camera_scan(data, T_odom_robot);
  const RangeScan& guard = params_.uses_scan() ? *data.scan : of_camera;
  const auto seen_with = [&](View& view, LocalOccupancy&& of_guard) {
    if (params_.uses_color()) {
      return view.camera_projector.project(of_camera);
    }
    if (!params_.uses_scan() || !params_.uses_depth()) {
      return std::move(of_guard);
    }
    presume_free(of_guard);
    return nearest_of(of_guard, view.camera_projector.project(of_camera));
  };

  Percept percept;
  LocalOccupancy seen = seen_.projector.project(guard, &percept.beams);
  percept.clear_ahead_m = cmn::clear_ahead_m(guard, seen, params_.guard);
  percept.seen = grown(seen_.accumulator->fuse(seen_with(seen_, std::move(seen)), T_odom_robot),
                       params_.grow_m, params_.local_occupancy.size);
  percept.is_complete =
      params_.uses_color() ? color_looks_.is_complete() : seen_.accumulator->is_complete();
  if (with_local_map) {
    percept.local_map = local_map_.accumulator->fuse(
        seen_with(local_map_, local_map_.projector.project(guard)), T_odom_robot);
  }
  percept.seen.heading_drift = seen_.accumulator->heading_drift();
  if (with_local_map && !percept.seen.heading_drift) {
    percept.seen.heading_drift = local_map_.accumulator->heading_drift();
  }
  return percept;
}

double Perception::clear_ahead_m(const SensorData& data) {
  const RangeScan of_depth = params_.uses_scan() ? RangeScan{} : depth_scan(data);
  const RangeScan& guard = params_.uses_scan() ? *data.scan : of_depth;
  return cmn::clear_ahead_m(guard, seen_.projector.project(guard), params_.guard);
}

void Perception::forget() {
  color_looks_.forget();
  seen_.accumulator->forget();
  local_map_.accumulator->forget();
}

}  // namespace cmn
