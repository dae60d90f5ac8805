// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_renderer.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/perception/depth_projection.hpp"
#include "coarse_map_nav/perception/panorama.hpp"
#include "coarse_map_nav/scene/depth_camera.hpp"
#include "coarse_map_nav/scene/slice.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kCell_m = 0.01;

CoarseMap sliced(const MeshScene& scene, const ExampleParams& params) {
  SliceParams how;
  how.resolution_m = kCell_m;
  how.band = {params.band_bottom_m, params.band_top_m};
  return slice(scene, how);
}

cv::Mat image_of(const CoarseMap& map) {
  cv::Mat image(map.height(), map.width(), CV_8UC1);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      image.at<std::uint8_t>(y, x) = map.is_occupied({x, y}) ? 1 : 0;
    }
  }
  return image;
}

/// Free cells with nothing within `clearance_m`.
std::vector<Cell> roomy_cells(const cv::Mat& occupied, double clearance_m) {
  cv::Mat distance;
  cv::distanceTransform(occupied == 0, distance, cv::DIST_L2, cv::DIST_MASK_5);
  std::vector<Cell> cells;
  for (int y = 0; y < distance.rows; ++y) {
    for (int x = 0; x < distance.cols; ++x) {
      if (distance.at<float>(y, x) * kCell_m > clearance_m) {
        cells.push_back({x, y});
      }
    }
  }
  return cells;
}

/// An optical frame that looks level along the robot's x, then turned up by `up_rad` and to the
/// left by `left_rad`.
Eigen::Matrix3d looking(double left_rad, double up_rad) {
  Eigen::Matrix3d R_robot_optical;  // columns: x to the right, y down, z ahead
  R_robot_optical << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return Eigen::AngleAxisd{left_rad, Eigen::Vector3d::UnitZ()} * R_robot_optical *
         Eigen::AngleAxisd{up_rad, Eigen::Vector3d::UnitX()}.toRotationMatrix();
}

/// White where a camera of that view and tilt fills the level view.
cv::Mat filled_by(double view_rad, double tilt_rad) {
  const CameraModel camera =
      CameraModel::from_field_of_view(160, view_rad < kPi / 2.0 ? 120 : 160, view_rad);
  const cv::Mat white(camera.height, camera.width, CV_8UC3, cv::Scalar::all(255));
  const Eigen::Matrix3d R_level_camera =
      Eigen::AngleAxisd{-tilt_rad, Eigen::Vector3d::UnitX()}.toRotationMatrix();
  cv::Mat filled;
  cv::inRange(level_view(white, camera, R_level_camera), cv::Scalar::all(250), cv::Scalar::all(255),
              filled);
  return filled;
}

/// The robot turned to where view k looks.
Pose2 turned_to(const Pose2& pose, std::size_t k) {
  return {pose.x, pose.y, wrap_angle(pose.yaw + static_cast<double>(k) * kPi / 2.0)};
}

}  // namespace

ExampleRenderer::ExampleRenderer(MeshScene scene, const ExampleParams& params, std::uint64_t seed)
    : params_{params},
      rng_{seed},
      scene_{std::make_shared<MeshScene>(std::move(scene))},
      lights_{scene_->lights},
      ambient_{scene_->ambient},
      caster_{make_ray_caster(scene_)},
      map_{sliced(*scene_, params)},
      occupied_{image_of(map_)} {
  const int reach = cvRound(0.5 * kWideSide_m / kWideSize / kCell_m);
  cv::dilate(occupied_, occupied_wide_, cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8UC1));
  places_ = roomy_cells(occupied_, params.clearance_m);
  if (places_.empty()) {
    throw std::runtime_error("the robot fits nowhere in the scene");
  }
  repaint(*scene_, params_.repainted_share, rng_);
}

double ExampleRenderer::uniform(double from, double to) {
  return from + (to - from) * draw_uniform(rng_);
}

void ExampleRenderer::relight() {
  const auto factor = [this] {
    return static_cast<float>(std::pow(params_.light_factor, uniform(-1.0, 1.0)));
  };
  scene_->ambient = factor() * ambient_;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    scene_->lights[i].strength = factor() * lights_[i].strength;
  }
}

cv::Mat ExampleRenderer::square_at(const Pose2& pose, const cv::Mat& map, int size,
                                   double side_m) const {
  const Pose2 T_grid_robot = inverse(map_.T_map_grid()) * pose;
  const double cell_m = side_m / size;
  const double c = std::cos(T_grid_robot.yaw) * cell_m / kCell_m;
  const double s = std::sin(T_grid_robot.yaw) * cell_m / kCell_m;
  // Column and row of the square -> those of the map; warpAffine counts from the cells' middles.
  const double middle = 0.5 * size - 0.5;
  const double x0 = T_grid_robot.x / kCell_m - 0.5 - (c * middle - s * middle);
  const double y0 = T_grid_robot.y / kCell_m - 0.5 - (s * middle + c * middle);
  const cv::Matx23d to_map{c, -s, x0, s, c, y0};
  cv::Mat square;
  cv::warpAffine(map, square, to_map, {size, size}, cv::INTER_NEAREST | cv::WARP_INVERSE_MAP,
                 cv::BORDER_CONSTANT, cv::Scalar::all(1));
  return square;  // kTruthOccupied is 1
}

Eigen::Isometry3d ExampleRenderer::T_robot_camera(double left_rad, double up_rad) const {
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.translation() = Eigen::Vector3d{forward_m_, 0.0, height_m_};
  T_robot_camera.linear() = looking(left_rad, up_rad);
  return T_robot_camera;
}

cv::Mat ExampleRenderer::view_at(const Pose2& pose, ColorCamera& camera) {
  const double error_rad = params_.pose_error_deg * kPi / 180.0;
  return camera.take(*caster_, in_space(pose) * T_robot_camera(error_rad * draw_normal(rng_),
                                                               error_rad * draw_normal(rng_)));
}

void ExampleRenderer::finish(Example& example) {
  const double blur = uniform(0.0, params_.most_blur);
  cv::Scalar cast;
  for (int i = 0; i < 3; ++i) {
    cast[i] = 1.0 + uniform(-params_.most_cast, params_.most_cast);
  }
  const cv::Mat filled = filled_by(example.view_rad, example.tilt_rad);
  for (cv::Mat& view : example.panorama.views) {
    if (blur > 0.2) {
      cv::GaussianBlur(view, view, {0, 0}, blur);
    }
    cv::multiply(view, cast, view);
    view.setTo(cv::Scalar::all(0), filled == 0);
  }
}

Example ExampleRenderer::next() {
  relight();
  const Cell place = places_[draw_index(rng_, places_.size())];
  const Point2 at = map_.center_of(place);
  const Pose2 pose{at.x, at.y, uniform(-kPi, kPi)};
  Example example;
  example.camera_height_m =
      static_cast<float>(uniform(params_.lowest_camera_m, params_.highest_camera_m));
  const bool is_whole = draw_uniform(rng_) < params_.whole_view_share;
  const double tilt_deg = uniform(-params_.most_tilt_deg, params_.most_tilt_deg);
  example.tilt_rad = static_cast<float>(is_whole ? 0.0 : tilt_deg * kPi / 180.0);
  const double view_deg = uniform(params_.narrowest_view_deg, 89.0);
  example.view_rad = static_cast<float>((is_whole ? 90.0 : view_deg) * kPi / 180.0);
  ColorCameraParams color;
  color.exposure_stops = uniform(-params_.most_exposure_stops, params_.most_exposure_stops);
  color.noise = uniform(0.0, params_.most_noise);
  ColorCamera camera{color, static_cast<std::uint32_t>(rng_())};
  forward_m_ = uniform(0.0, params_.most_forward_m);
  pose_ = pose;
  height_m_ = static_cast<double>(example.camera_height_m);
  tilt_rad_ = static_cast<double>(example.tilt_rad);
  view_rad_ = static_cast<double>(example.view_rad);
  for (std::size_t k = 0; k < kViewCount; ++k) {
    example.panorama.views[k] = view_at(turned_to(pose, k), camera);
  }
  finish(example);
  example.near = square_at(pose, occupied_, kNearSize, kNearSide_m);
  example.wide = square_at(pose, occupied_wide_, kWideSize, kWideSide_m);
  mark_seen(example.near, kNearSide_m, example.view_rad);
  mark_seen(example.wide, kWideSide_m, example.view_rad);
  return example;
}

PredictedOccupancy ExampleRenderer::last_by_depth() {
  DepthCameraParams faults;
  faults.width = faults.height = 320;
  faults.field_of_view_deg = view_rad_ * 180.0 / kPi;
  DepthCamera camera{faults, static_cast<std::uint32_t>(height_m_ * 1e6)};
  DepthParams how;
  how.highest_m = params_.band_top_m;
  DepthProjector depth{how};
  RangeProjector near{{kNearSize, kNearSide_m, 0.0}};
  RangeProjector wide{{kWideSize, kWideSide_m, 0.0}};
  Panorama near_round{PanoramaParams{}};
  Panorama wide_round{PanoramaParams{}};
  PredictedOccupancy seen;
  for (std::size_t k = kViewCount; k-- > 0;) {  // the view ahead is the last
    DepthImage image;
    image.camera = camera.camera();
    image.T_robot_camera = T_robot_camera(0.0, -tilt_rad_);
    image.depth_m = camera.take(*caster_, in_space(turned_to(pose_, k)) * image.T_robot_camera);
    const RangeScan scan = depth.scan(image);
    const Pose2 T_odom_robot{0.0, 0.0, wrap_angle(static_cast<double>(k) * kPi / 2.0)};
    seen.near = near_round.fuse(near.project(scan), T_odom_robot);
    seen.wide = wide_round.fuse(wide.project(scan), T_odom_robot);
  }
  return seen;
}

}  // namespace cmn
