// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/house_scene.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/scene/patterns.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace cmn {
namespace {

constexpr float kLampBelowCeiling_m = 0.25F;
constexpr float kPanel_m = 0.02F;  ///< half of the thickness of panes and shut doors

Eigen::Vector3f point(double x, double y, double z) {
  return Eigen::Vector3d{x, y, z}.cast<float>();
}

bool is_wet(RoomPurpose purpose) {
  return purpose == RoomPurpose::kBath || purpose == RoomPurpose::kKitchen;
}

class HouseBuilder {
 public:
  HouseBuilder(const House& house, std::uint32_t seed, FurnitureMeshes* meshes)
      : house_{house}, rng_{seed}, meshes_{meshes} {}

  MeshScene build() {
    const std::uint32_t wall = scene_.add_material({"wall", pale(), {}});
    for (const Wall& block : house_.walls) {
      add_box(scene_, point(block.area.x0, block.area.y0, block.bottom_m),
              point(block.area.x1, block.area.y1, block.top_m), wall);
    }
    const std::uint32_t ceiling = scene_.add_material({"ceiling", {0.93F, 0.93F, 0.92F}, {}});
    const std::uint32_t wood = scene_.add_material(floor("wood", plank_pattern(rng_)));
    const std::uint32_t tiles = scene_.add_material(floor("tiles", tile_pattern(rng_)));
    for (const Room& room : house_.rooms) {
      add_floor(room.area, is_wet(room.purpose) ? tiles : wood);
      add_ceiling(room.area, ceiling);
      Light lamp;
      const Point2 middle = room.area.middle();
      lamp.position = point(middle.x, middle.y, house_.ceiling_m);
      lamp.position.z() -= kLampBelowCeiling_m;
      lamp.strength =
          static_cast<float>(1.5 + 2.0 * draw_uniform(rng_)) * Eigen::Vector3f{1.0F, 0.95F, 0.85F};
      scene_.lights.push_back(lamp);
    }
    for (const Opening& opening : house_.openings) {
      add_opening(opening, wood, ceiling);
    }
    for (const Furniture& piece : house_.furniture) {
      add_piece(piece);
    }
    return std::move(scene_);
  }

 private:
  Eigen::Vector3f pale() {
    const double light = 0.75 + 0.2 * draw_uniform(rng_);
    return point(light, light - 0.06 * draw_uniform(rng_), light - 0.15 * draw_uniform(rng_));
  }
  static Material floor(const std::string& name, const cv::Mat& pattern) {
    Material made;
    made.name = name;
    made.texture = pattern;
    return made;
  }

  /// A level face whose texture repeats every two metres.
  void add_level(const Rectangle& area, double z, bool is_up, std::uint32_t material) {
    std::array<Eigen::Vector3f, 4> corners{point(area.x0, area.y0, z), point(area.x1, area.y0, z),
                                           point(area.x1, area.y1, z), point(area.x0, area.y1, z)};
    if (!is_up) {
      std::reverse(corners.begin(), corners.end());
    }
    scene_.add_quad(corners, material);
    for (std::size_t i = scene_.vertices.size() - 4; i < scene_.vertices.size(); ++i) {
      scene_.texture_points[i] = scene_.vertices[i].head<2>() / kPatternSide_m;
    }
  }
  void add_floor(const Rectangle& area, std::uint32_t material) {
    add_level(area, 0.0, true, material);
  }
  void add_ceiling(const Rectangle& area, std::uint32_t material) {
    add_level(area, house_.ceiling_m, false, material);
  }

  void add_opening(const Opening& opening, std::uint32_t floor, std::uint32_t ceiling) {
    if (opening.kind == Opening::Kind::kDoor || opening.kind == Opening::Kind::kPassage) {
      add_floor(opening.area, floor);
      if (opening.top_m >= house_.ceiling_m) {
        add_ceiling(opening.area, ceiling);
      }
      return;
    }
    Eigen::Vector3f low = point(opening.area.x0, opening.area.y0, opening.bottom_m);
    Eigen::Vector3f high = point(opening.area.x1, opening.area.y1, opening.top_m);
    const int across = opening.area.width() < opening.area.height() ? 0 : 1;
    const float middle = 0.5F * (low[across] + high[across]);
    low[across] = middle - kPanel_m;
    high[across] = middle + kPanel_m;
    if (opening.kind == Opening::Kind::kEntrance) {
      add_box(scene_, low, high, scene_.add_material({"door", paint(), {}}));
      return;
    }
    Material pane{"pane", {0.8F, 0.9F, 0.95F}, {}};
    pane.opacity = 0.1F;
    add_box(scene_, low, high, scene_.add_material(pane));
  }

  /// Wood, white or a colour, as furniture is.
  Eigen::Vector3f paint() {
    const double kind = draw_uniform(rng_);
    const double light = 0.35 + 0.5 * draw_uniform(rng_);
    if (kind < 0.5) {
      return point(light, 0.72 * light, 0.5 * light);
    }
    if (kind < 0.8) {
      return point(light, light, light);
    }
    return point(0.8 * draw_uniform(rng_), 0.8 * draw_uniform(rng_), 0.8 * draw_uniform(rng_));
  }

  void add_piece(const Furniture& piece) {
    const Pose2& pose = piece.T_house_piece;
    const Eigen::Affine3d T_house_piece{Eigen::Translation3d{pose.x, pose.y, 0.0} *
                                        Eigen::AngleAxisd{pose.yaw, Eigen::Vector3d::UnitZ()}};
    if (meshes_ != nullptr) {
      std::mt19937_64 rng{seed_of(piece)};
      if (const std::optional<MeshScene> mesh = meshes_->fit(piece, rng)) {
        add(scene_, *mesh, T_house_piece);
        return;
      }
    }
    MeshScene boxes;
    const std::uint32_t material = boxes.add_material({piece.name, paint_of(piece.name), {}});
    for (const FurniturePart& part : piece.parts) {
      const Eigen::Vector3f low = point(part.area.x0, part.area.y0, part.bottom_m);
      const Eigen::Vector3f high = point(part.area.x1, part.area.y1, part.top_m);
      part.is_round ? add_cylinder(boxes, low, high, material)
                    : add_box(boxes, low, high, material);
    }
    add(scene_, boxes, T_house_piece);
  }

  /// Pieces of one kind match within a room: the same chairs around a table.
  std::uint64_t seed_of(const Furniture& piece) {
    const auto [at, is_new] = seeds_.emplace(std::pair{piece.room, piece.name}, 0);
    if (is_new) {
      at->second = rng_();
    }
    return at->second;
  }

  /// Boxes of one kind are of one colour within a house.
  Eigen::Vector3f paint_of(const std::string& kind) {
    const auto [at, is_new] = paints_.emplace(kind, Eigen::Vector3f::Zero());
    if (is_new) {
      at->second = paint();
    }
    return at->second;
  }

  const House& house_;
  std::mt19937_64 rng_;
  FurnitureMeshes* meshes_;
  MeshScene scene_;
  std::map<std::pair<int, std::string>, std::uint64_t> seeds_;  ///< by room and kind
  std::map<std::string, Eigen::Vector3f> paints_;               ///< by kind of furniture
};

}  // namespace

MeshScene house_scene(const House& house, std::uint32_t seed, FurnitureMeshes* meshes) {
  return HouseBuilder{house, seed, meshes}.build();
}

}  // namespace cmn
