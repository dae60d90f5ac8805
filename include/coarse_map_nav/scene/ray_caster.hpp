// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rays into a MeshScene.
#pragma once

#include "coarse_map_nav/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace cmn {

/// A half line. `direction` need not have length 1: ways along it are in units of its length.
struct SceneRay {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float reach = std::numeric_limits<float>::infinity();
};

/// The first opaque surface on a ray.
struct Hit {
  static constexpr std::uint32_t kNothing = 0xffffffffU;
  float way = std::numeric_limits<float>::infinity();
  std::uint32_t triangle = kNothing;  ///< index
  float u = 0.0F, v = 0.0F;           ///< weights of the triangle's second and third corner

  bool is_hit() const { return triangle != kNothing; }
};

/// Finds what rays meet. Clear panes and holes of textures let them pass. Neighbouring rays that
/// lie close together are fast. Calls do not disturb each other.
class RayCaster {
 public:
  virtual ~RayCaster() = default;
  /// The first hit of every ray; `hits` gets the size of `rays`.
  virtual void cast(const std::vector<SceneRay>& rays, std::vector<Hit>& hits) const = 0;
  /// For every ray 1 when anything lies within its reach, else 0.
  virtual void find_blocked(const std::vector<SceneRay>& rays,
                            std::vector<std::uint8_t>& is_blocked) const = 0;
  virtual const MeshScene& scene() const = 0;
};

/// By Intel Embree. Throws std::runtime_error with the reason, and how to get it, in a build
/// without the 3D simulator.
std::unique_ptr<RayCaster> make_ray_caster(std::shared_ptr<const MeshScene> scene);

/// The unit normal at a hit, towards where the ray came from.
Eigen::Vector3f normal_at(const MeshScene& scene, const Hit& hit, const Eigen::Vector3f& direction);
/// The same of the triangle itself, without the smoothing of `normals`.
Eigen::Vector3f face_normal(const MeshScene& scene, const Hit& hit,
                            const Eigen::Vector3f& direction);

}  // namespace cmn
