// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/sdf_reader.hpp"

#include "coarse_map_nav/scene/mesh_reader.hpp"
#include "coarse_map_nav/scene/model_folders.hpp"
#include "coarse_map_nav/scene/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <sdf/sdf.hh>

namespace cmn {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTriangles = 20'000'000;
/// What has no material in SDF is grey in Gazebo as well.
const Eigen::Vector3f kGrey{0.7F, 0.7F, 0.7F};

Eigen::Affine3d affine(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  return Eigen::Translation3d{pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z()} *
         Eigen::Quaterniond{q.W(), q.X(), q.Y(), q.Z()}.normalized();
}

Eigen::Vector3f rgb(const ignition::math::Color& colour) {
  const Eigen::Vector3f made{colour.R(), colour.G(), colour.B()};
  return made.allFinite() ? made : kGrey;
}

std::string folder_of(const std::string& file) { return fs::path{file}.parent_path().string(); }

/// sdformat reads the includes of included files with its global settings: ours, for so long.
class GlobalConfig {
 public:
  explicit GlobalConfig(const sdf::ParserConfig& config) {
    sdf::ParserConfig::GlobalConfig() = config;
  }
  ~GlobalConfig() { sdf::ParserConfig::GlobalConfig() = before_; }
  GlobalConfig(const GlobalConfig&) = delete;
  GlobalConfig& operator=(const GlobalConfig&) = delete;

 private:
  sdf::ParserConfig before_ = sdf::ParserConfig::GlobalConfig();
};

class SdfReader {
 public:
  SdfReader(const std::string& path, std::vector<std::string>& warnings, SdfPart part)
      : path_{path}, folders_{model_folders(path)}, warnings_{warnings}, part_{part} {}

  MeshScene read() {
    for (const std::string& uri : check_includes(path_, folders_)) {
      warn(path_, "there is no " + uri);
    }
    sdf::Console::Instance()->SetQuiet(true);
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
    config.SetFindCallback(
        [this](const std::string& uri) { return find_uri(uri, folder_of(path_), folders_); });
    const GlobalConfig global{config};
    sdf::Root root;
    sdf::Errors errors;
    try {
      errors = root.Load(path_, config);
    } catch (const std::exception& e) {
      throw std::runtime_error(path_ + ": " + e.what());
    }
    for (const sdf::Error& error : errors) {
      warnings_.push_back(path_ + ": sdformat says: " + error.Message());
    }
    for (std::uint64_t i = 0; i < root.WorldCount(); ++i) {
      read(*root.WorldByIndex(i));
    }
    if (root.Model() != nullptr) {
      read(*root.Model(), Eigen::Affine3d::Identity());
    }
    if (scene_.triangles.empty()) {
      throw std::runtime_error(path_ + ": nothing in it has a surface" +
                               (errors.empty() ? "" : " (" + errors.front().Message() + ")"));
    }
    return std::move(scene_);
  }

 private:
  void warn(const std::string& where, const std::string& what) {
    warnings_.push_back(where + ": " + what);
  }

  /// The pose of a part in what holds it. None: it is not a number or nowhere.
  template <class Element>
  std::optional<Eigen::Affine3d> pose_of(const Element& element) {
    ignition::math::Pose3d pose;
    const sdf::Errors errors = element.SemanticPose().Resolve(pose);
    if (!errors.empty()) {
      warn(element.Name(), errors.front().Message() + " Its plain pose is taken.");
      pose = element.RawPose();
    }
    const Eigen::Affine3d T_parent_child = affine(pose);
    if (!T_parent_child.matrix().allFinite() || T_parent_child.translation().norm() > 1e5) {
      warn(element.Name(), "its pose is no place; it is left out");
      return std::nullopt;
    }
    return T_parent_child;
  }

  void read(const sdf::World& world) {
    if (const sdf::Scene* look = world.Scene()) {
      scene_.ambient = rgb(look->Ambient());
    }
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      read(*world.ModelByIndex(i), Eigen::Affine3d::Identity());
    }
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      read(*world.LightByIndex(i), Eigen::Affine3d::Identity());
    }
  }

  void read(const sdf::Model& model, const Eigen::Affine3d& T_world_parent) {
    const auto pose = pose_of(model);
    if (!pose) {
      return;
    }
    const Eigen::Affine3d T_world_child = T_world_parent * *pose;
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      read(*model.LinkByIndex(i), T_world_child);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      read(*model.ModelByIndex(i), T_world_child);
    }
  }

  void read(const sdf::Link& link, const Eigen::Affine3d& T_world_model) {
    const auto pose = pose_of(link);
    if (!pose) {
      return;
    }
    const Eigen::Affine3d T_world_link = T_world_model * *pose;
    for (std::uint64_t i = 0; i < link.LightCount(); ++i) {
      read(*link.LightByIndex(i), T_world_link);
    }
    if (part_ == SdfPart::kVisual) {
      for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
        const sdf::Visual& visual = *link.VisualByIndex(i);
        read(visual, visual.Geom(), material_of(visual), T_world_link);
      }
    } else {
      for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
        const sdf::Collision& collision = *link.CollisionByIndex(i);
        read(collision, collision.Geom(), std::nullopt, T_world_link);
      }
    }
  }

  void read(const sdf::Light& from, const Eigen::Affine3d& T_world_parent) {
    const auto pose = pose_of(from);
    if (!pose) {
      return;
    }
    Light light;
    const Eigen::Affine3d T_world_light = T_world_parent * *pose;
    const auto& along = from.Direction();
    light.position = T_world_light.translation().cast<float>();
    light.direction = (T_world_light.linear() * Eigen::Vector3d{along.X(), along.Y(), along.Z()})
                          .normalized()
                          .cast<float>();
    light.is_sun = from.Type() == sdf::LightType::DIRECTIONAL;
    light.strength = static_cast<float>(from.Intensity()) * rgb(from.Diffuse());
    light.falloff =
        Eigen::Vector3d{from.ConstantAttenuationFactor(), from.LinearAttenuationFactor(),
                        from.QuadraticAttenuationFactor()}
            .cast<float>();
    if (from.Type() == sdf::LightType::SPOT) {
      light.cone_cos = static_cast<float>(std::cos(0.5 * from.SpotOuterAngle().Radian()));
    }
    if (light.direction.allFinite() && light.strength.allFinite() && light.falloff.allFinite() &&
        light.falloff.maxCoeff() > 0.0F) {
      scene_.lights.push_back(light);
    } else {
      warn(from.Name(), "this light is left out: its figures make no sense");
    }
  }

  /// What the visual says itself; none: what the mesh says.
  std::optional<Material> material_of(const sdf::Visual& visual) {
    const sdf::Material* from = visual.Material();
    if (from == nullptr) {
      return std::nullopt;
    }
    Material made;
    made.name = visual.Name();
    made.colour =
        from->Element() && from->Element()->HasElement("diffuse") ? rgb(from->Diffuse()) : kGrey;
    made.opacity = 1.0F - visual.Transparency();
    const sdf::Pbr* pbr = from->PbrMaterial();
    const sdf::PbrWorkflow* metal =
        pbr == nullptr ? nullptr : pbr->Workflow(sdf::PbrWorkflowType::METAL);
    if (metal != nullptr && !metal->AlbedoMap().empty()) {
      const std::string file = find_uri(metal->AlbedoMap(), folder_of(from->FilePath()), folders_);
      try {
        made.texture =
            file.empty() ? cv::Mat{} : texture_of(cv::imread(file, cv::IMREAD_UNCHANGED));
      } catch (const cv::Exception&) {
        made.texture = cv::Mat{};
      }
      if (made.texture.empty()) {
        warn(visual.Name(), "no picture " + metal->AlbedoMap() + "; its colour is taken instead");
      }
    }
    return made;
  }

  template <class Element>
  void read(const Element& element, const sdf::Geometry* geometry,
            const std::optional<Material>& material, const Eigen::Affine3d& T_world_link) {
    const auto pose = pose_of(element);
    if (!pose || geometry == nullptr) {
      return;
    }
    if (geometry->Type() == sdf::GeometryType::MESH) {
      add_mesh(*geometry->MeshShape(), material, T_world_link * *pose);
      return;
    }
    MeshScene part;
    part.add_material(material.value_or(Material{element.Name(), kGrey, {}}));
    if (add_shape(part, *geometry)) {
      add_part(part, T_world_link * *pose);
    } else if (geometry->Type() != sdf::GeometryType::EMPTY) {
      warn(element.Name(), "its geometry is of a kind or size that is not read; it is left out");
    }
  }

  static bool add_ellipsoid(MeshScene& part, const Eigen::Vector3d& radii) {
    if (!radii.allFinite() || radii.minCoeff() <= 0.0) {
      return false;
    }
    MeshScene ball;
    ball.materials = part.materials;
    add_sphere(ball, 1.0F, 0);
    part.materials.clear();
    add(part, ball, Eigen::Affine3d{Eigen::Scaling(radii)});
    return true;
  }

  static bool add_plane(MeshScene& part, const sdf::Plane& plane) {
    const auto& n = plane.Normal();
    const Eigen::Vector3d normal{n.X(), n.Y(), n.Z()};
    const float x = 0.5F * static_cast<float>(plane.Size().X());
    const float y = 0.5F * static_cast<float>(plane.Size().Y());
    if (!normal.allFinite() || normal.norm() < 1e-9 || !(x > 0.0F && y > 0.0F)) {
      return false;
    }
    MeshScene flat;
    flat.materials = part.materials;
    flat.add_quad({Eigen::Vector3f{-x, -y, 0.0F}, {x, -y, 0.0F}, {x, y, 0.0F}, {-x, y, 0.0F}}, 0);
    part.materials.clear();
    add(part, flat,
        Eigen::Affine3d{Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal)});
    return true;
  }

  static bool add_shape(MeshScene& part, const sdf::Geometry& geometry) {
    using Type = sdf::GeometryType;
    switch (geometry.Type()) {
      case Type::PLANE:
        return add_plane(part, *geometry.PlaneShape());
      case Type::SPHERE:
        return add_ellipsoid(part, Eigen::Vector3d::Constant(geometry.SphereShape()->Radius()));
      case Type::ELLIPSOID: {
        const auto radii = geometry.EllipsoidShape()->Radii();
        return add_ellipsoid(part, {radii.X(), radii.Y(), radii.Z()});
      }
      case Type::CAPSULE: {
        const auto& capsule = *geometry.CapsuleShape();
        return add_ellipsoid(
            part, {capsule.Radius(), capsule.Radius(), 0.5 * capsule.Length() + capsule.Radius()});
      }
      case Type::BOX: {
        const auto size = geometry.BoxShape()->Size();
        return add_about_its_middle(part, {size.X(), size.Y(), size.Z()}, add_box);
      }
      case Type::CYLINDER: {
        const auto& cylinder = *geometry.CylinderShape();
        const double width = 2.0 * cylinder.Radius();
        return add_about_its_middle(part, {width, width, cylinder.Length()}, add_cylinder);
      }
      default:
        return false;
    }
  }

  /// `add_between`: what adds the shape that fills the box between two corners.
  template <class AddBetween>
  static bool add_about_its_middle(MeshScene& part, const Eigen::Vector3d& size,
                                   const AddBetween& add_between) {
    const Eigen::Vector3f half = (0.5 * size).cast<float>();
    if (!half.allFinite() || half.minCoeff() <= 0.0F) {
      return false;
    }
    add_between(part, -half, half, 0);
    return true;
  }

  void add_mesh(const sdf::Mesh& mesh, const std::optional<Material>& material,
                const Eigen::Affine3d& T_world_mesh) {
    const auto& s = mesh.Scale();
    const Eigen::Vector3d scale{s.X(), s.Y(), s.Z()};
    if (!scale.allFinite() || scale.cwiseAbs().minCoeff() < 1e-9) {
      warn(mesh.Uri(), "its scale is no scale; it is left out");
      return;
    }
    const std::string file = find_uri(mesh.Uri(), folder_of(mesh.FilePath()), folders_);
    if (file.empty()) {
      warn(mesh.FilePath(), "there is no mesh " + mesh.Uri());
      return;
    }
    if (!mesh.Submesh().empty()) {
      warn(file, "all of it is read, not its part " + mesh.Submesh() + " alone");
    }
    const auto [at, is_new] = meshes_.emplace(file, MeshScene{});
    if (is_new) {
      try {
        at->second = read_mesh(file, warnings_);
      } catch (const std::runtime_error& e) {
        warnings_.emplace_back(e.what());
      }
    }
    const Eigen::Affine3d T_world_part = T_world_mesh * Eigen::Scaling(scale);
    if (!material) {
      add_part(at->second, T_world_part);
      return;
    }
    MeshScene painted = at->second;
    std::fill(painted.materials.begin(), painted.materials.end(), *material);
    add_part(painted, T_world_part);
  }

  void add_part(const MeshScene& part, const Eigen::Affine3d& T_world_part) {
    if (scene_.triangles.size() + part.triangles.size() > kMostTriangles) {
      throw std::runtime_error(path_ + ": it comes to more than " + std::to_string(kMostTriangles) +
                               " triangles");
    }
    add(scene_, part, T_world_part);
  }

  const std::string& path_;
  const std::vector<std::string> folders_;
  std::vector<std::string>& warnings_;
  const SdfPart part_;
  MeshScene scene_;
  std::map<std::string, MeshScene> meshes_;  ///< by file
};

}  // namespace

MeshScene read_sdf(const std::string& path, std::vector<std::string>& warnings, SdfPart part) {
  if (!fs::is_regular_file(path)) {
    throw std::runtime_error(path + ": no such file");
  }
  return SdfReader{path, warnings, part}.read();
}

}  // namespace cmn
