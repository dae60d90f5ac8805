// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Pairs of panorama and truth from a scene, each taken by another camera in another light.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/learning/example.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"
#include "coarse_map_nav/scene/color_camera.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// How far the examples of one scene lie apart. Draws are uniform up to the bounds unless said
/// otherwise. What a robot knows of its camera (its view and tilt) shows as black borders of the
/// levelled views; what it does not know shows as errors.
struct ExampleParams {
  double lowest_camera_m = 0.25;
  double highest_camera_m = 0.6;
  double most_forward_m = 0.1;
  double whole_view_share = 0.7;
  double narrowest_view_deg = 55.0;
  double most_tilt_deg = 15.0;
  double pose_error_deg = 1.5;
  double most_exposure_stops = 0.7;
  double most_noise = 8.0;
  double most_blur = 0.8;
  double most_cast = 0.15;
  double repainted_share = 0.5;
  double light_factor = 3.0;
  double band_bottom_m = 0.02;
  double band_top_m = 0.6;
  double clearance_m = 0.18;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("lowest_camera_m", self.lowest_camera_m, Between{0.05, 2.0}, "[m] above the floor");
    visit("highest_camera_m", self.highest_camera_m, Between{0.05, 2.0}, "[m] above the floor");
    visit("most_forward_m", self.most_forward_m, Between{0.0, 0.5},
          "[m] of the camera before the middle about which the robot turns");
    visit("whole_view_share", self.whole_view_share, Between{0.0, 1.0},
          "[-] of the cameras, those that fill the views of 90 degrees");
    visit("narrowest_view_deg", self.narrowest_view_deg, Between{30.0, 90.0},
          "[deg] horizontal view of the others, at least");
    visit("most_tilt_deg", self.most_tilt_deg, Between{0.0, 45.0},
          "[deg] up or down, known to the robot, of the others");
    visit("pose_error_deg", self.pose_error_deg, Between{0.0, 10.0},
          "[deg] standard deviation of a view's yaw and tilt that the robot does not know");
    visit("most_exposure_stops", self.most_exposure_stops, Between{0.0, 4.0},
          "[powers of two] brighter or darker than medium");
    visit("most_noise", self.most_noise, Between{0.0, 64.0},
          "standard deviation of a channel, of which white has 255");
    visit("most_blur", self.most_blur, Between{0.0, 5.0}, "[pixels] standard deviation");
    visit("most_cast", self.most_cast, Between{0.0, 1.0},
          "[-] by which a colour's channel is stronger or weaker in all views");
    visit("repainted_share", self.repainted_share, Between{0.0, 1.0},
          "[-] of the materials, those that get another colour or pattern");
    visit("light_factor", self.light_factor, Between{1.0, 20.0},
          "[-] lamps are up to so much stronger or weaker than in the scene");
    visit("band_bottom_m", self.band_bottom_m, Between{0.0, 2.0},
          "[m] what reaches above this and ...");
    visit("band_top_m", self.band_top_m, Between{0.01, 3.0},
          "[m] ... below this, from the floor, is occupied");
    visit("clearance_m", self.clearance_m, Between{0.05, 1.0},
          "[m] of the robot's middle from everything");
  }
};

/// Gives a share of a scene's materials another colour, or a pattern: planks, tiles, blotches.
void repaint(MeshScene& scene, double share, std::mt19937_64& rng);

/// Takes examples in one scene.
class ExampleRenderer {
 public:
  /// `seed` decides everything. Throws std::runtime_error when the robot fits nowhere in the scene,
  /// or in a build without the 3D simulator.
  ExampleRenderer(MeshScene scene, const ExampleParams& params, std::uint64_t seed);

  Example next();
  /// What the depth of the same four looks as those of the last example comes to by projection: to
  /// compare a network with. The camera is known exactly and has a RealSense's faults.
  PredictedOccupancy last_by_depth();

 private:
  /// A look straight ahead with the last example's camera.
  Eigen::Isometry3d T_robot_camera(double left_rad, double up_rad) const;
  void relight();
  /// The truth around a pose, from the fine map.
  cv::Mat square_at(const Pose2& pose, const cv::Mat& map, int size, double side_m) const;
  cv::Mat view_at(const Pose2& pose, ColorCamera& camera);
  void finish(Example& example);
  double uniform(double from, double to);

  ExampleParams params_;
  std::mt19937_64 rng_;
  std::shared_ptr<MeshScene> scene_;
  std::vector<Light> lights_;  ///< as the scene came
  Eigen::Vector3f ambient_;
  std::unique_ptr<RayCaster> caster_;
  CoarseMap map_;             ///< of cells of 1 cm
  cv::Mat occupied_;          ///< the same as an image, row = y
  cv::Mat occupied_wide_;     ///< whether anything is within half a wide cell
  std::vector<Cell> places_;  ///< where the robot fits
  // Of the last example.
  Pose2 pose_;
  double forward_m_ = 0.0;
  double height_m_ = 0.0;
  double tilt_rad_ = 0.0;
  double view_rad_ = 0.0;
};

}  // namespace cmn
