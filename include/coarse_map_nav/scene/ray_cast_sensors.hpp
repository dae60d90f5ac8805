// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SceneSensors by rays.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/scene/color_camera.hpp"
#include "coarse_map_nav/scene/depth_camera.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/simulation/range_sensor.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"
#include "coarse_map_nav/simulation/sensor_mounts.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace cmn {

struct RayCastSensorParams {
  LidarParams lidar;
  DepthCameraParams depth;
  ColorCameraParams color;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit.group("lidar", self.lidar);
    visit.group("depth", self.depth);
    visit.group("color", self.color);
  }
};

/// One robot's sensors in one scene. Several robots may share a caster.
class RayCastSensors : public SceneSensors {
 public:
  RayCastSensors(std::shared_ptr<const RayCaster> caster, const RayCastSensorParams& params,
                 const SensorMounts& mounts, std::uint32_t seed);

  RangeScan scan(const Pose2& T_world_robot, double stamp_s) override;
  DepthImage depth(const Pose2& T_world_robot, double stamp_s) override;
  ColorImage color(const Pose2& T_world_robot, double stamp_s) override;
  /// The depth image without noise and faults; +inf where there is nothing.
  DepthImage true_depth(const Pose2& T_world_robot, double stamp_s);
  const CameraModel& color_camera() const { return color_.camera(); }

 private:
  std::shared_ptr<const RayCaster> caster_;
  SensorMounts mounts_;
  double lidar_reach_m_;
  RangeSensor lidar_;
  DepthCamera depth_;
  ColorCamera color_;
  std::vector<SceneRay> beams_;
  std::vector<Hit> hits_;
};

}  // namespace cmn
