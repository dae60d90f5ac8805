// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A stereo depth camera in a MeshScene, with the faults of a RealSense.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/scene/camera_rays.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// About the RealSense D435 of the LoCoBot. Figures are plausible ones of ours: the maker promises
/// an error below 2 % at 2 m; ours is 1 % there and, as of any stereo, grows with depth squared.
struct DepthCameraParams {
  int width = 320;
  int height = 240;
  double field_of_view_deg = 75.0;
  double depth_min_m = 0.3;
  double depth_max_m = 8.0;
  double noise_m = 0.0025;
  double step_m = 0.0016;
  double baseline_m = 0.05;
  double grazing_deg = 6.0;
  double faintest = 0.0015;
  double flying_share = 0.3;
  double stripe_share = 0.0;
  double dropout = 0.002;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("width", self.width, Between{8, 1920}, "[pixels]");
    visit("height", self.height, Between{8, 1080}, "[pixels]");
    visit("field_of_view_deg", self.field_of_view_deg, Between{20.0, 150.0}, "[deg] horizontal");
    visit("depth_min_m", self.depth_min_m, Between{0.0, 2.0}, "[m] nearer things are holes");
    visit("depth_max_m", self.depth_max_m, Between{0.5, 50.0}, "[m] farther things are holes");
    visit("noise_m", self.noise_m, Between{0.0, 0.1},
          "[m] gaussian error at 1 m; grows with the square of the depth");
    visit("step_m", self.step_m, Between{0.0, 0.1},
          "[m] between the depths that can be told apart at 1 m; grows likewise");
    visit("baseline_m", self.baseline_m, Between{0.0, 0.3},
          "[m] between the two eyes; what only one of them sees beside a near thing is a hole");
    visit("grazing_deg", self.grazing_deg, Between{0.0, 45.0},
          "[deg] surfaces seen under a smaller angle are often holes");
    visit("faintest", self.faintest, Between{0.0, 1.0},
          "[-] surfaces that give back less light (reflectance x cos / depth^2) are often holes");
    visit("flying_share", self.flying_share, Between{0.0, 1.0},
          "[-] of the pixels at an edge, those that hang between near and far");
    visit("stripe_share", self.stripe_share, Between{0.0, 1.0},
          "[-] of the columns, those in stripes of wrong depth, as in low light");
    visit("dropout", self.dropout, Between{0.0, 1.0}, "[-] of all pixels, holes without a cause");
  }
  CameraModel camera() const;
};

/// Takes depth images, each in one instant.
class DepthCamera {
 public:
  DepthCamera(const DepthCameraParams& params, std::uint32_t seed);

  /// CV_32FC1 [m]; holes are NaN. The same seed and calls give the same images.
  cv::Mat take(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera);
  /// The same without noise and faults; +inf where there is nothing.
  cv::Mat truth(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera);
  const CameraModel& camera() const { return camera_; }

 private:
  void cast(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera);
  void drop_weak(const RayCaster& caster, cv::Mat& depth);
  void drop_half_seen(cv::Mat& depth) const;
  void let_fly(cv::Mat& depth);
  void blur(cv::Mat& depth);
  float uniform() { return rng_.uniform(0.0F, 1.0F); }

  DepthCameraParams params_;
  CameraModel camera_;
  CameraRays rays_;
  cv::RNG rng_;
  const std::vector<SceneRay>* cast_rays_ = nullptr;  ///< of the last cast
  std::vector<Hit> hits_;                             ///< likewise
};

}  // namespace cmn
