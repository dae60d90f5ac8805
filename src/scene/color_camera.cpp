// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/color_camera.hpp"

#include "coarse_map_nav/scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cmn {
namespace {

constexpr float kLift_m = 2e-3F;  ///< a shadow ray starts so far off its surface
constexpr float kSunAway_m = 1e3F;
constexpr std::size_t kMostLights = 16;
/// A light of a smaller share of what the others leave is not worth a ray.
constexpr float kFaint = 0.03F;
const Eigen::Vector3f kSky{0.45F, 0.55F, 0.7F};
/// Auto exposure puts the mean of an image here, on the linear scale; that of middle grey.
constexpr float kMiddle = 0.2F;

/// Of a channel in sRGB (IEC 61966-2-1).
const std::array<float, 256>& linear_of_srgb() {
  static const std::array<float, 256> kTable = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float c = static_cast<float>(i) / 255.0F;
      table[i] = c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
    }
    return table;
  }();
  return kTable;
}

constexpr int kShades = 4096;
/// 255 times the channel in sRGB, of a linear one from 0 to 1.
const std::array<float, kShades + 1>& srgb_of_linear() {
  static const std::array<float, kShades + 1> kTable = [] {
    std::array<float, kShades + 1> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float c = static_cast<float>(i) / kShades;
      table[i] =
          255.0F * (c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F);
    }
    return table;
  }();
  return kTable;
}

/// What a light throws on a point of a surface; zero from behind.
Eigen::Vector3f strength_at(const Light& light, const Eigen::Vector3f& point,
                            const Eigen::Vector3f& normal) {
  if (light.is_sun) {
    return std::max(0.0F, -normal.dot(light.direction)) * light.strength;
  }
  const Eigen::Vector3f to_light = light.position - point;
  const float along = normal.dot(to_light);
  if (along <= 0.0F) {
    return Eigen::Vector3f::Zero();
  }
  const float d = to_light.norm();
  if (-light.direction.dot(to_light) < light.cone_cos * d) {
    return Eigen::Vector3f::Zero();
  }
  const float loss = light.falloff[0] + light.falloff[1] * d + light.falloff[2] * d * d;
  return along / (d * std::max(1e-3F, loss)) * light.strength;
}

}  // namespace

CameraModel ColorCameraParams::camera() const {
  return CameraModel::from_field_of_view(width, height, field_of_view_deg * kPi / 180.0);
}

ColorCamera::ColorCamera(const ColorCameraParams& params, std::uint32_t seed)
    : params_{params},
      camera_{params.camera()},
      rays_{camera_, params.samples},
      rng_{seed + 1ULL} {}

void ColorCamera::choose_lamps(const MeshScene& scene, const Eigen::Vector3f& eye) {
  std::vector<const Light*> lights;
  for (const Light& light : scene.lights) {
    lights.push_back(&light);
  }
  const auto brightness = [&](const Light* light) {
    return light->is_sun ? std::numeric_limits<float>::infinity()
                         : light->strength.sum() /
                               (light->falloff.sum() * (light->position - eye).squaredNorm());
  };
  if (lights.size() > kMostLights) {
    std::nth_element(lights.begin(), lights.begin() + kMostLights, lights.end(),
                     [&](const Light* a, const Light* b) { return brightness(a) > brightness(b); });
    lights.resize(kMostLights);
  }
  lamps_.resize(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lamps_[i].light = lights[i];
    lamps_[i].lit.clear();
    lamps_[i].strengths.clear();
    lamps_[i].rays.clear();
  }
}

void ColorCamera::light(const MeshScene& scene, std::size_t ray, const Eigen::Vector3f& point,
                        const Eigen::Vector3f& normal) {
  shaded_[ray] = scene.ambient * (0.8F + 0.2F * normal.z());
  std::array<Eigen::Vector3f, kMostLights> strengths;
  std::array<float, kMostLights> brightness{};
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    strengths[i] = strength_at(*lamps_[i].light, point, normal);
    brightness[i] = strengths[i].sum();
    if (params_.shadow_lights == 0) {
      shaded_[ray] += strengths[i];
    }
  }
  const Eigen::Vector3f lifted = point + kLift_m * normal;
  for (int shadow = 0; shadow < params_.shadow_lights; ++shadow) {
    const auto brightest = std::max_element(brightness.begin(), brightness.end());
    if (*brightest <= kFaint * shaded_[ray].sum()) {  // 0 as well: there are no more lamps
      break;
    }
    const auto i = static_cast<std::size_t>(brightest - brightness.begin());
    Lamp& lamp = lamps_[i];
    const Eigen::Vector3f source =
        lamp.light->is_sun ? Eigen::Vector3f{lifted - kSunAway_m * lamp.light->direction}
                           : lamp.light->position;
    lamp.lit.push_back(ray);
    lamp.strengths.push_back(strengths[i]);
    lamp.rays.push_back({source, lifted - source, 1.0F});
    *brightest = -1.0F;
  }
}

void ColorCamera::shade(const RayCaster& caster, const std::vector<SceneRay>& rays) {
  const MeshScene& scene = caster.scene();
  shaded_.resize(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits_[i].is_hit()) {
      light(scene, i, rays[i].origin + hits_[i].way * rays[i].direction,
            normal_at(scene, hits_[i], rays[i].direction));
    }
  }
  for (const Lamp& lamp : lamps_) {
    caster.find_blocked(lamp.rays, is_hidden_);
    for (std::size_t i = 0; i < lamp.lit.size(); ++i) {
      if (is_hidden_[i] == 0) {
        shaded_[lamp.lit[i]] += lamp.strengths[i];
      }
    }
  }
  const auto& linear = linear_of_srgb();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits_[i].is_hit()) {
      const cv::Vec3b c = colour_at(scene, hits_[i]);
      shaded_[i] =
          shaded_[i].cwiseProduct(Eigen::Vector3f{linear[c[2]], linear[c[1]], linear[c[0]]});
    } else {
      shaded_[i] = kSky;
    }
  }
}

float ColorCamera::exposure(const cv::Mat& linear) const {
  const cv::Scalar mean = cv::mean(linear);
  const double level = (mean[0] + mean[1] + mean[2]) / 3.0;
  const double automatic = params_.auto_exposure ? kMiddle / std::max(level, 1e-3) : 1.0;
  return static_cast<float>(automatic * std::exp2(params_.exposure_stops));
}

cv::Mat ColorCamera::take(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera) {
  const std::vector<SceneRay>& rays =
      rays_.from(T_world_camera, std::numeric_limits<float>::infinity());
  caster.cast(rays, hits_);
  choose_lamps(caster.scene(), T_world_camera.translation().cast<float>());
  shade(caster, rays);
  cv::Mat linear = cv::Mat::zeros(camera_.height, camera_.width, CV_32FC3);
  auto* sums = linear.ptr<cv::Vec3f>();
  const float weight = 1.0F / static_cast<float>(params_.samples * params_.samples);
  for (std::size_t i = 0; i < shaded_.size(); ++i) {
    const Eigen::Vector3f c = weight * shaded_[i].cwiseMin(8.0F);
    sums[rays_.pixel_of(i)] += cv::Vec3f{c.z(), c.y(), c.x()};
  }
  cv::Mat noise(linear.size(), CV_32FC3, cv::Scalar::all(0.0));
  if (params_.noise > 0.0) {
    rng_.fill(noise, cv::RNG::NORMAL, 0.0, params_.noise);
  }
  const float gain = exposure(linear) * kShades;
  const auto& srgb = srgb_of_linear();
  cv::Mat image(linear.size(), CV_8UC3);
  const auto* value = linear.ptr<float>();
  const auto* error = noise.ptr<float>();
  auto* byte = image.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < 3 * linear.total(); ++i) {
    const float shade = std::min(gain * value[i], static_cast<float>(kShades));
    byte[i] = cv::saturate_cast<std::uint8_t>(srgb[static_cast<std::size_t>(shade)] + error[i]);
  }
  return image;
}

}  // namespace cmn
