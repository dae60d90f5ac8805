// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/scene.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <cmath>
#include <utility>

namespace cmn {
namespace {

constexpr int kSegments = 24;  ///< around a round thing

std::uint32_t count_of(const std::vector<Eigen::Vector3f>& vertices) {
  return static_cast<std::uint32_t>(vertices.size());
}

void add_vertex(MeshScene& scene, const Eigen::Vector3f& p, const Eigen::Vector3f& normal,
                const Eigen::Vector2f& texture_point) {
  scene.vertices.push_back(p);
  scene.normals.push_back(normal);
  scene.texture_points.push_back(texture_point);
}

/// Joins the rows of a lattice of (rows + 1) x (kSegments + 1) vertices that begins at `first`.
void join_rows(MeshScene& scene, std::uint32_t first, std::uint32_t rows, std::uint32_t material) {
  constexpr std::uint32_t kStride = kSegments + 1;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const std::uint32_t a = first + row * kStride + i;
      scene.triangles.push_back({{a, a + 1, a + kStride + 1}, material});
      scene.triangles.push_back({{a, a + kStride + 1, a + kStride}, material});
    }
  }
}

}  // namespace

std::uint32_t MeshScene::add_material(Material material) {
  materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(materials.size() - 1);
}

void MeshScene::add_quad(const std::array<Eigen::Vector3f, 4>& corners, std::uint32_t material) {
  const std::uint32_t first = count_of(vertices);
  const std::array<Eigen::Vector2f, 4> points{
      Eigen::Vector2f{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
  for (std::size_t i = 0; i < 4; ++i) {
    add_vertex(*this, corners[i], Eigen::Vector3f::Zero(), points[i]);
  }
  triangles.push_back({{first, first + 1, first + 2}, material});
  triangles.push_back({{first, first + 2, first + 3}, material});
}

Eigen::AlignedBox3f MeshScene::bounds() const {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : vertices) {
    box.extend(p);
  }
  return box;
}

void add(MeshScene& scene, const MeshScene& part, const Eigen::Affine3d& T_scene_part) {
  const Eigen::Affine3f to_scene = T_scene_part.cast<float>();
  const Eigen::Matrix3f turn = T_scene_part.linear().inverse().transpose().cast<float>();
  const std::uint32_t first = count_of(scene.vertices);
  const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const Eigen::Vector3f normal = turn * part.normals[i];
    add_vertex(scene, to_scene * part.vertices[i], normal.isZero() ? normal : normal.normalized(),
               part.texture_points[i]);
  }
  for (Triangle triangle : part.triangles) {
    for (std::uint32_t& corner : triangle.corners) {
      corner += first;
    }
    triangle.material += first_material;
    scene.triangles.push_back(triangle);
  }
  scene.materials.insert(scene.materials.end(), part.materials.begin(), part.materials.end());
  for (Light light : part.lights) {
    light.position = to_scene * light.position;
    light.direction = (to_scene.linear() * light.direction).normalized();
    scene.lights.push_back(light);
  }
}

void add_box(MeshScene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
             std::uint32_t material) {
  const auto corner = [&](int x, int y, int z) {
    return Eigen::Vector3f{x == 0 ? low.x() : high.x(), y == 0 ? low.y() : high.y(),
                           z == 0 ? low.z() : high.z()};
  };
  scene.add_quad({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}, material);
  scene.add_quad({corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}, material);
  scene.add_quad({corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1)}, material);
  scene.add_quad({corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1)}, material);
  scene.add_quad({corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}, material);
  scene.add_quad({corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0), corner(0, 0, 0)}, material);
}

void add_cylinder(MeshScene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                  std::uint32_t material) {
  const Eigen::Vector3f middle = 0.5F * (low + high);
  const Eigen::Vector3f half = 0.5F * (high - low);
  const std::uint32_t side = count_of(scene.vertices);
  // Rows of vertices: the side, then each end from its rim to its middle.
  for (int row = 0; row < 6; ++row) {
    const bool is_side = row < 2;
    const float z = row == 0 || row == 2 || row == 3 ? low.z() : high.z();
    const float radius = row == 3 || row == 5 ? 0.0F : 1.0F;
    for (int i = 0; i <= kSegments; ++i) {
      const float turn = static_cast<float>(i) / kSegments;
      const float c = std::cos(turn * 2.0F * static_cast<float>(kPi));
      const float s = std::sin(turn * 2.0F * static_cast<float>(kPi));
      const Eigen::Vector3f out =
          is_side ? Eigen::Vector3f{c / half.x(), s / half.y(), 0.0F}.normalized()
                  : Eigen::Vector3f{0.0F, 0.0F, row < 4 ? -1.0F : 1.0F};
      add_vertex(scene, {middle.x() + radius * half.x() * c, middle.y() + radius * half.y() * s, z},
                 out,
                 is_side ? Eigen::Vector2f{turn, static_cast<float>(row)}
                         : Eigen::Vector2f{0.5F + 0.5F * radius * c, 0.5F + 0.5F * radius * s});
    }
  }
  for (std::uint32_t pair = 0; pair < 3; ++pair) {
    join_rows(scene, side + pair * 2 * (kSegments + 1), 1, material);
  }
}

void add_sphere(MeshScene& scene, float radius, std::uint32_t material) {
  constexpr std::uint32_t kRows = kSegments / 2;
  const std::uint32_t first = count_of(scene.vertices);
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    const float share = static_cast<float>(row) / kRows;
    const float polar = share * static_cast<float>(kPi);
    for (int i = 0; i <= kSegments; ++i) {
      const float turn = static_cast<float>(i) / kSegments;
      const float azimuth = turn * 2.0F * static_cast<float>(kPi);
      const Eigen::Vector3f out{std::sin(polar) * std::cos(azimuth),
                                std::sin(polar) * std::sin(azimuth), -std::cos(polar)};
      add_vertex(scene, radius * out, out, {turn, share});
    }
  }
  join_rows(scene, first, kRows, material);
}

}  // namespace cmn
