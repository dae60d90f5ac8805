// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/ray_caster.hpp"

namespace cmn {
namespace {

Eigen::Vector3f towards(const Eigen::Vector3f& normal, const Eigen::Vector3f& direction) {
  return normal.dot(direction) > 0.0F ? Eigen::Vector3f{-normal} : normal;
}

}  // namespace

Eigen::Vector3f face_normal(const MeshScene& scene, const Hit& hit,
                            const Eigen::Vector3f& direction) {
  const Triangle& triangle = scene.triangles[hit.triangle];
  const Eigen::Vector3f& a = scene.vertices[triangle.corners[0]];
  const Eigen::Vector3f& b = scene.vertices[triangle.corners[1]];
  const Eigen::Vector3f& c = scene.vertices[triangle.corners[2]];
  return towards((b - a).cross(c - a).normalized(), direction);
}

Eigen::Vector3f normal_at(const MeshScene& scene, const Hit& hit,
                          const Eigen::Vector3f& direction) {
  const Triangle& triangle = scene.triangles[hit.triangle];
  const Eigen::Vector3f smooth = (1.0F - hit.u - hit.v) * scene.normals[triangle.corners[0]] +
                                 hit.u * scene.normals[triangle.corners[1]] +
                                 hit.v * scene.normals[triangle.corners[2]];
  const float length = smooth.norm();
  // Shorter: no smooth normals, or such that cancel each other.
  return length < 0.1F ? face_normal(scene, hit, direction) : towards(smooth / length, direction);
}

}  // namespace cmn
