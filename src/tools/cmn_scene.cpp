// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_scene: what is in a world with heights, as figures, a map and pictures.

#include "coarse_map_nav/mapping/map_writer.hpp"
#include "coarse_map_nav/scene/color_camera.hpp"
#include "coarse_map_nav/scene/depth_camera.hpp"
#include "coarse_map_nav/scene/extrusion.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/scene/slice.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace {

namespace po = boost::program_options;

void write_picture(const std::string& path, const cv::Mat& picture) {
  bool is_written = false;
  try {
    is_written = cv::imwrite(path, picture);
  } catch (const cv::Exception&) {
    is_written = false;
  }
  if (!is_written) {
    throw std::runtime_error(path + ": cannot be written; does the folder exist?");
  }
  std::cout << path << "\n";
}

/// A level camera at a pose on the floor, `height_m` above it, tilted down by `tilt_rad`.
Eigen::Isometry3d camera_at(const cmn::Pose2& T_world_robot, double height_m, double tilt_rad) {
  Eigen::Matrix3d optical;  // columns: the optical axes x (right), y (down), z (ahead)
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return cmn::in_space(T_world_robot) * Eigen::Translation3d{0.0, 0.0, height_m} *
         Eigen::AngleAxisd{tilt_rad, Eigen::Vector3d::UnitY()} *
         Eigen::Isometry3d{Eigen::AngleAxisd{optical}};
}

cmn::ColorCameraParams camera(int width, int height, double view_deg, int samples) {
  cmn::ColorCameraParams params;
  params.width = width;
  params.height = height;
  params.field_of_view_deg = view_deg;
  params.samples = samples;
  params.noise = 0.0;
  return params;
}

/// From high above; what is higher than `cut_m` is taken away.
cv::Mat seen_from_above(const cmn::MeshScene& scene, const cmn::CoarseMap& body, double cut_m) {
  auto open = std::make_shared<cmn::MeshScene>(scene);
  open->triangles.clear();
  for (const cmn::Triangle& triangle : scene.triangles) {
    double lowest = 1e9;
    for (const std::uint32_t corner : triangle.corners) {
      lowest = std::min(lowest, double{scene.vertices[corner].z()});
    }
    if (lowest < cut_m) {
      open->triangles.push_back(triangle);
    }
  }
  constexpr double kHigh_m = 60.0;
  const double width_m = body.width() * body.resolution();
  const double height_m = body.height() * body.resolution();
  const double scale = 1400.0 / std::max(width_m, height_m);
  cmn::ColorCameraParams params =
      camera(static_cast<int>(width_m * scale), static_cast<int>(height_m * scale),
             2.0 * std::atan(0.5 * width_m / kHigh_m) * 180.0 / cmn::kPi, 2);
  params.shadow_lights = 0;
  open->lights.assign(1, {});
  open->lights[0].is_sun = true;
  open->lights[0].direction = Eigen::Vector3f{0.3F, 0.4F, -1.0F}.normalized();
  const cmn::Point2 middle = body.T_map_grid() * cmn::Point2{0.5 * width_m, 0.5 * height_m};
  const Eigen::Isometry3d T_world_camera =
      Eigen::Translation3d{middle.x, middle.y, kHigh_m} *
      Eigen::Isometry3d{Eigen::AngleAxisd{cmn::kPi, Eigen::Vector3d::UnitX()}};
  return cmn::ColorCamera{params, 1}.take(*cmn::make_ray_caster(open), T_world_camera);
}

/// Near is bright; holes are dark red.
cv::Mat picture_of(const cv::Mat& depth_m, double farthest_m) {
  cv::Mat picture(depth_m.size(), CV_8UC3);
  for (int row = 0; row < depth_m.rows; ++row) {
    for (int column = 0; column < depth_m.cols; ++column) {
      const float z = depth_m.at<float>(row, column);
      const auto shade = cv::saturate_cast<std::uint8_t>(255.0 * (1.0 - z / farthest_m));
      picture.at<cv::Vec3b>(row, column) =
          std::isfinite(z) ? cv::Vec3b{shade, shade, shade} : cv::Vec3b{0, 0, 90};
    }
  }
  return picture;
}

po::options_description options() {
  po::options_description options{
      "cmn_scene --world FILE.world|FILE.sdf|FILE.yaml|house:SEED --out DIR\n\n"
      "Prints what is in the world and what could not be read, and writes into DIR: body.yaml and\n"
      ".png (the map that a robot's body can drive in), lidar.yaml and .png (the plane of its\n"
      "LiDAR), above.png, and from a place in it panorama.png, depth.png and view.png.\n"
      "Options"};
  options.add_options()("help", "print this")("world", po::value<std::string>(), "what to look at")(
      "out", po::value<std::string>(), "the folder to write to")(
      "resolution", po::value<double>()->default_value(0.05), "of the maps [m]")(
      "lidar-height", po::value<double>()->default_value(0.2), "of the plane of lidar.yaml [m]")(
      "x", po::value<double>(), "where to look from [m]; without it a place is drawn")(
      "y", po::value<double>(), "likewise")("yaw", po::value<double>()->default_value(0.0),
                                            "where to look to [deg]")(
      "height", po::value<double>()->default_value(0.6), "of the cameras [m]")(
      "tilt", po::value<double>()->default_value(10.0), "of the cameras, downwards [deg]")(
      "seed", po::value<std::uint32_t>()->default_value(1),
      "of the place that is drawn, and noise")("boxes", "houses without meshes of furniture")(
      "maps-only", "no pictures");
  return options;
}

cmn::Pose2 place(const po::variables_map& given, const cmn::CoarseMap& body) {
  const double yaw = given["yaw"].as<double>() * cmn::kPi / 180.0;
  if (given.count("x") != 0 && given.count("y") != 0) {
    return {given["x"].as<double>(), given["y"].as<double>(), yaw};
  }
  std::mt19937 rng{given["seed"].as<std::uint32_t>()};
  const auto drawn = cmn::World{body}.random_free_pose(0.3, rng);
  if (!drawn) {
    throw std::runtime_error("no place is free: give --x and --y");
  }
  return {drawn->x, drawn->y, yaw};
}

void write_views(const po::variables_map& given, const cmn::SceneWorld& world,
                 const std::string& folder) {
  const cmn::Pose2 at = place(given, world.body);
  const double height_m = given["height"].as<double>();
  const double tilt_rad = given["tilt"].as<double>() * cmn::kPi / 180.0;
  std::cout << "seen from " << at.x << ", " << at.y << "\n";
  const auto caster = cmn::make_ray_caster(world.scene);
  const Eigen::Isometry3d ahead = camera_at(at, height_m, tilt_rad);
  write_picture(folder + "/view.png",
                cmn::ColorCamera{camera(960, 720, 75.0, 2), 1}.take(*caster, ahead));
  std::vector<cv::Mat> strip;
  for (int quarter = 0; quarter < 4; ++quarter) {  // from left to right: a robot pivots right
    const cmn::Pose2 turned{at.x, at.y, at.yaw - quarter * cmn::kPi / 2.0};
    strip.push_back(cmn::ColorCamera{camera(320, 320, 90.0, 2), 1}.take(
        *caster, camera_at(turned, height_m, 0.0)));
  }
  cv::Mat panorama;
  cv::hconcat(strip, panorama);
  write_picture(folder + "/panorama.png", panorama);
  cmn::DepthCameraParams params;
  params.width = 640;
  params.height = 480;
  cmn::DepthCamera depth{params, given["seed"].as<std::uint32_t>()};
  cv::Mat both;
  cv::hconcat(picture_of(depth.truth(*caster, ahead), 6.0),
              picture_of(depth.take(*caster, ahead), 6.0), both);
  write_picture(folder + "/depth.png", both);
}

int run(int argc, char** argv) {
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options()), given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options();
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  if (given.count("world") == 0 || given.count("out") == 0) {
    throw std::runtime_error("--world NAME and --out DIR are needed; --help explains");
  }
  const std::string folder = given["out"].as<std::string>();
  cmn::SceneWorldParams params;
  params.resolution_m = given["resolution"].as<double>();
  if (given.count("boxes") != 0) {
    params.furniture_folder.clear();
  }
  const cmn::SceneWorld world = cmn::open_scene_world(given["world"].as<std::string>(), params);
  for (const std::string& warning : world.warnings) {
    std::cout << "warning: " << warning << "\n";
  }
  const Eigen::AlignedBox3f box = world.scene->bounds();
  std::cout << world.scene->triangles.size() << " triangles, " << world.scene->materials.size()
            << " materials, " << world.scene->lights.size() << " lights; from "
            << box.min().transpose() << " to " << box.max().transpose() << " m; a body can be on "
            << static_cast<double>(world.body.free_count()) * std::pow(world.body.resolution(), 2)
            << " m2\n";
  cmn::write_map(folder + "/body.yaml", world.body);
  cmn::SliceParams plane;
  plane.resolution_m = params.resolution_m;
  plane.band = {given["lidar-height"].as<double>(), given["lidar-height"].as<double>()};
  cmn::write_map(folder + "/lidar.yaml", cmn::slice(*world.scene, plane));
  std::cout << folder << "/body.yaml\n" << folder << "/lidar.yaml\n";
  if (given.count("maps-only") == 0) {
    write_picture(folder + "/above.png", seen_from_above(*world.scene, world.body, 1.8));
    write_views(given, world, folder);
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
