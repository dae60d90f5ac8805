// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A colour camera in a MeshScene.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/scene/camera_rays.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// The size and view are those of CMN's panoramas: four images of 80 x 80 that join.
struct ColorCameraParams {
  int width = 80;
  int height = 80;
  double field_of_view_deg = 90.0;
  int samples = 1;
  int shadow_lights = 2;
  bool auto_exposure = true;
  double exposure_stops = 0.0;
  double noise = 2.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("width", self.width, Between{8, 1920}, "[pixels]");
    visit("height", self.height, Between{8, 1080}, "[pixels]");
    visit("field_of_view_deg", self.field_of_view_deg, Between{20.0, 150.0}, "[deg] horizontal");
    visit("samples", self.samples, Between{1, 8},
          "rays along either side of a pixel: more smooth its edges");
    visit("shadow_lights", self.shadow_lights, Between{0, 8},
          "a point is lit by so many of its strongest lights, where they are not hidden from it; "
          "0: by all, through walls as well");
    visit("auto_exposure", self.auto_exposure, Anything{}, "every image is of medium brightness");
    visit("exposure_stops", self.exposure_stops, Between{-8.0, 8.0},
          "brightness beyond that, in powers of two");
    visit("noise", self.noise, Between{0.0, 64.0},
          "gaussian error of a channel, of which white has 255");
  }
  CameraModel camera() const;
};

/// Takes colour images. Surfaces scatter light evenly; what the lights leave dark gets the scene's
/// ambient light.
class ColorCamera {
 public:
  ColorCamera(const ColorCameraParams& params, std::uint32_t seed);

  /// CV_8UC3, BGR. The same seed and calls give the same images.
  cv::Mat take(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera);
  const CameraModel& camera() const { return camera_; }

 private:
  /// A light that matters for an image, and what it throws where nothing stands between.
  struct Lamp {
    const Light* light;
    std::vector<std::size_t> lit;            ///< indices of camera rays
    std::vector<Eigen::Vector3f> strengths;  ///< on each of them: RGB, linear
    std::vector<SceneRay> rays;              ///< from the light to each of them
  };
  void choose_lamps(const MeshScene& scene, const Eigen::Vector3f& eye);
  void shade(const RayCaster& caster, const std::vector<SceneRay>& rays);
  void light(const MeshScene& scene, std::size_t ray, const Eigen::Vector3f& point,
             const Eigen::Vector3f& normal);
  float exposure(const cv::Mat& linear) const;

  ColorCameraParams params_;
  CameraModel camera_;
  CameraRays rays_;
  cv::RNG rng_;
  std::vector<Hit> hits_;
  std::vector<Lamp> lamps_;
  std::vector<Eigen::Vector3f> shaded_;  ///< light of every ray, then times its colour
  std::vector<std::uint8_t> is_hidden_;
};

}  // namespace cmn
