// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/scene/texture.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <embree3/rtcore.h>

namespace cmn {
namespace {

constexpr unsigned kPacket = 8;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

/// Of a texture that has holes.
bool has_holes(const Material& material) {
  if (material.texture.empty()) {
    return false;
  }
  for (int row = 0; row < material.texture.rows; ++row) {
    const auto* texel = material.texture.ptr<cv::Vec4b>(row);
    if (std::any_of(texel, texel + material.texture.cols,
                    [](const cv::Vec4b& t) { return t[3] < 128; })) {
      return true;
    }
  }
  return false;
}

/// Triangles that Embree knows together; it counts them from 0.
struct Part {
  const MeshScene* scene = nullptr;
  std::vector<std::uint32_t> triangles;  ///< indices in the scene
};

/// Lets rays pass through the holes of textures.
void filter_holes(const RTCFilterFunctionNArguments* arguments) {
  const auto& part = *static_cast<const Part*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) {
      continue;
    }
    Hit hit;
    hit.triangle = part.triangles[RTCHitN_primID(arguments->hit, arguments->N, i)];
    hit.u = RTCHitN_u(arguments->hit, arguments->N, i);
    hit.v = RTCHitN_v(arguments->hit, arguments->N, i);
    if (texel_at(*part.scene, hit)[3] < 128) {
      arguments->valid[i] = 0;
    }
  }
}

class EmbreeRayCaster : public RayCaster {
 public:
  explicit EmbreeRayCaster(std::shared_ptr<const MeshScene> scene)
      : scene_{std::move(scene)}, device_{rtcNewDevice("threads=1,set_affinity=0")} {
    if (!device_) {
      throw std::runtime_error("Embree does not start: error " +
                               std::to_string(rtcGetDeviceError(nullptr)));
    }
    embree_scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(embree_scene_.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips between triangles
    std::vector<bool> is_holed(scene_->materials.size());
    std::transform(scene_->materials.begin(), scene_->materials.end(), is_holed.begin(), has_holes);
    for (std::uint32_t i = 0; i < scene_->triangles.size(); ++i) {
      const std::uint32_t material = scene_->triangles[i].material;
      if (scene_->materials[material].opacity >= kClear) {
        (is_holed[material] ? holed_ : solid_).triangles.push_back(i);
      }
    }
    add(solid_, false);
    add(holed_, true);
    rtcCommitScene(embree_scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
      throw std::runtime_error("Embree does not take this scene: error " + std::to_string(error));
    }
  }

  void cast(const std::vector<SceneRay>& rays, std::vector<Hit>& hits) const override {
    hits.resize(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
      RTCRayHit8 packet;
      alignas(32) std::array<int, kPacket> valid{};
      const std::size_t count = fill(packet.ray, valid, rays, first);
      std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcIntersect8(valid.data(), embree_scene_.get(), &context, &packet);
      for (std::size_t i = 0; i < count; ++i) {
        Hit& hit = hits[first + i];
        hit = {};
        if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
          const Part& part = packet.hit.geomID[i] == solid_id_ ? solid_ : holed_;
          hit = {packet.ray.tfar[i], part.triangles[packet.hit.primID[i]], packet.hit.u[i],
                 packet.hit.v[i]};
        }
      }
    }
  }

  void find_blocked(const std::vector<SceneRay>& rays,
                    std::vector<std::uint8_t>& is_blocked) const override {
    is_blocked.resize(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
      RTCRay8 packet;
      alignas(32) std::array<int, kPacket> valid{};
      const std::size_t count = fill(packet, valid, rays, first);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcOccluded8(valid.data(), embree_scene_.get(), &context, &packet);
      for (std::size_t i = 0; i < count; ++i) {
        is_blocked[first + i] = packet.tfar[i] < 0.0F ? 1 : 0;  // Embree says so by -inf
      }
    }
  }

  const MeshScene& scene() const override { return *scene_; }

 private:
  /// The rays from `first` on that fit into a packet; returns how many.
  static std::size_t fill(RTCRay8& packet, std::array<int, kPacket>& valid,
                          const std::vector<SceneRay>& rays, std::size_t first) {
    const std::size_t count = std::min<std::size_t>(kPacket, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const SceneRay& ray = rays[first + i];
      valid[i] = -1;
      packet.org_x[i] = ray.origin.x();
      packet.org_y[i] = ray.origin.y();
      packet.org_z[i] = ray.origin.z();
      packet.dir_x[i] = ray.direction.x();
      packet.dir_y[i] = ray.direction.y();
      packet.dir_z[i] = ray.direction.z();
      packet.tnear[i] = 0.0F;
      packet.tfar[i] = ray.reach;
      packet.time[i] = 0.0F;
      packet.mask[i] = 0xffffffffU;
      packet.flags[i] = 0;
    }
    return count;
  }

  void add(Part& part, bool has_holes) {
    part.scene = scene_.get();
    if (part.triangles.empty()) {
      return;
    }
    const Geometry geometry{rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE)};
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), scene_->vertices.size()));
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), part.triangles.size()));
    if (vertices == nullptr || corners == nullptr) {
      throw std::runtime_error("Embree has no memory for this scene");
    }
    for (const Eigen::Vector3f& p : scene_->vertices) {
      vertices = std::copy(p.data(), p.data() + 3, vertices);
    }
    for (const std::uint32_t i : part.triangles) {
      const Triangle& triangle = scene_->triangles[i];
      corners = std::copy(triangle.corners.begin(), triangle.corners.end(), corners);
    }
    if (has_holes) {
      rtcSetGeometryUserData(geometry.get(), &part);
      rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_holes);
      rtcSetGeometryOccludedFilterFunction(geometry.get(), filter_holes);
    }
    rtcCommitGeometry(geometry.get());
    const unsigned id = rtcAttachGeometry(embree_scene_.get(), geometry.get());
    if (!has_holes) {
      solid_id_ = id;
    }
  }

  std::shared_ptr<const MeshScene> scene_;
  Device device_;
  EmbreeScene embree_scene_;
  Part solid_;
  Part holed_;
  unsigned solid_id_ = RTC_INVALID_GEOMETRY_ID;
};

}  // namespace

std::unique_ptr<RayCaster> make_ray_caster(std::shared_ptr<const MeshScene> scene) {
  return std::make_unique<EmbreeRayCaster>(std::move(scene));
}

}  // namespace cmn
