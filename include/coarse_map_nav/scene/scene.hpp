// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A world with heights: triangles, what they are painted with, and lamps. Plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace cmn {

/// What a surface looks like. It scatters light evenly in all directions (Lambert).
struct Material {
  std::string name;
  Eigen::Vector3f colour{0.7F, 0.7F, 0.7F};  ///< share of red, green and blue given back, sRGB
  /// CV_8UC4, BGRA; its colour takes the place of `colour`. Empty: none. Less than half opaque
  /// texels are holes (leaves, lattices).
  cv::Mat texture;
  float opacity = 1.0F;  ///< below kClear light and lidar pass, bodies do not
};
/// Panes are clear: cameras and lidars see through them.
constexpr float kClear = 0.5F;

struct Triangle {
  std::array<std::uint32_t, 3> corners{};  ///< indices of vertices
  std::uint32_t material = 0;              ///< index
};

/// A lamp without extent, or the sun.
///
/// On what faces it at distance d a lamp throws `strength` / (f0 + f1 d + f2 d^2), d in metres and
/// f the `falloff`, within the cone around its direction; the sun throws `strength`.
struct Light {
  bool is_sun = false;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< [m]; not of the sun
  Eigen::Vector3f direction{0.0F, 0.0F, -1.0F};        ///< unit; its light travels so
  float cone_cos = -1.0F;                              ///< of half the cone's angle; -1: all round
  Eigen::Vector3f strength = Eigen::Vector3f::Constant(2.5F);  ///< red, green, blue
  Eigen::Vector3f falloff{0.2F, 0.0F, 1.0F};
};

/// Triangles in one frame, z up [m]. A scene that is read is the world's; one part of a world (a
/// model, a piece of furniture) is a scene as well.
struct MeshScene {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;         ///< of the vertices, unit; zero: the triangle's own
  std::vector<Eigen::Vector2f> texture_points;  ///< of the vertices; (0, 0) is the lower left
  std::vector<Triangle> triangles;
  std::vector<Material> materials;
  std::vector<Light> lights;
  Eigen::Vector3f ambient = Eigen::Vector3f::Constant(0.35F);  ///< light that comes from everywhere

  /// Adds a material and returns its index.
  std::uint32_t add_material(Material material);
  /// Adds a flat face, in the order of its corners around it; the texture covers it once.
  void add_quad(const std::array<Eigen::Vector3f, 4>& corners, std::uint32_t material);
  Eigen::AlignedBox3f bounds() const;  ///< empty without vertices
};

/// Puts a part into a scene: shear and scale are allowed, mirroring too.
void add(MeshScene& scene, const MeshScene& part, const Eigen::Affine3d& T_scene_part);

/// A box from `low` to `high`, each face covered once by the texture.
void add_box(MeshScene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
             std::uint32_t material);
/// An upright elliptic cylinder that fills the box from `low` to `high`.
void add_cylinder(MeshScene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                  std::uint32_t material);
/// A sphere about the origin of the scene's frame.
void add_sphere(MeshScene& scene, float radius, std::uint32_t material);

}  // namespace cmn
