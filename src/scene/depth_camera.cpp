// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/depth_camera.hpp"

#include "coarse_map_nav/scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();
/// Neighbours whose depths differ by so much of the nearer one lie at an edge.
constexpr float kEdge = 0.1F;
/// Stereo matches patches, so that errors of neighbours are alike.
constexpr int kPatch = 3;
constexpr std::array<int, 2> kStripeWidth{2, 9};  ///< [pixels] least, greatest and one
/// Within a stripe the error is greater.
constexpr float kStripeNoise = 6.0F;

/// How much infrared light a surface gives back.
float reflectance(const MeshScene& scene, const Hit& hit) {
  const cv::Vec3b c = colour_at(scene, hit);
  const float mean = static_cast<float>(c[0] + c[1] + c[2]) / (3.0F * 255.0F);
  return std::pow(mean, 2.2F);
}

}  // namespace

CameraModel DepthCameraParams::camera() const {
  return CameraModel::from_field_of_view(width, height, field_of_view_deg * kPi / 180.0);
}

DepthCamera::DepthCamera(const DepthCameraParams& params, std::uint32_t seed)
    : params_{params}, camera_{params.camera()}, rays_{camera_}, rng_{seed + 1ULL} {}

void DepthCamera::cast(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera) {
  cast_rays_ = &rays_.from(T_world_camera, std::numeric_limits<float>::infinity());
  caster.cast(*cast_rays_, hits_);
}

cv::Mat DepthCamera::truth(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera) {
  cast(caster, T_world_camera);
  cv::Mat depth(camera_.height, camera_.width, CV_32FC1);
  auto* pixels = depth.ptr<float>();
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    pixels[rays_.pixel_of(i)] = hits_[i].way;
  }
  return depth;
}

cv::Mat DepthCamera::take(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera) {
  cv::Mat depth = truth(caster, T_world_camera);
  drop_half_seen(depth);
  drop_weak(caster, depth);
  let_fly(depth);
  blur(depth);
  return depth;
}

void DepthCamera::drop_half_seen(cv::Mat& depth) const {
  const auto shift = static_cast<float>(camera_.fx * params_.baseline_m);  // [pixels m]
  for (int row = 0; row < depth.rows; ++row) {
    auto* pixels = depth.ptr<float>(row);
    // The left eye's image: the right eye has column u at u - shift / depth. What is nearer and
    // comes from farther right hides it there.
    float leftmost = std::numeric_limits<float>::infinity();
    for (int column = depth.cols - 1; column >= 0; --column) {
      const float seen_at = static_cast<float>(column) - shift / pixels[column];
      if (seen_at > leftmost + 0.5F) {
        pixels[column] = kHole;
      }
      leftmost = std::min(leftmost, seen_at);
    }
  }
}

void DepthCamera::drop_weak(const RayCaster& caster, cv::Mat& depth) {
  const auto grazing = static_cast<float>(std::sin(params_.grazing_deg * kPi / 180.0));
  const auto faintest = static_cast<float>(params_.faintest);
  const auto dropout = static_cast<float>(params_.dropout);
  auto* pixels = depth.ptr<float>();
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    float& z = pixels[rays_.pixel_of(i)];
    const float chance = uniform();
    if (!(z >= static_cast<float>(params_.depth_min_m) &&
          z <= static_cast<float>(params_.depth_max_m)) ||
        chance < dropout) {
      z = kHole;
      continue;
    }
    const Eigen::Vector3f& direction = (*cast_rays_)[i].direction;
    const float cosine =
        -face_normal(caster.scene(), hits_[i], direction).dot(direction) / direction.norm();
    const float back = reflectance(caster.scene(), hits_[i]) * cosine / (z * z);
    // The weaker, the likelier a hole.
    if (chance * grazing > cosine || chance * faintest > back) {
      z = kHole;
    }
  }
}

void DepthCamera::let_fly(cv::Mat& depth) {
  const auto share = static_cast<float>(params_.flying_share);
  for (int row = 0; share > 0.0F && row < depth.rows; ++row) {
    auto* pixels = depth.ptr<float>(row);
    for (int column = 1; column < depth.cols; ++column) {
      const float near = std::min(pixels[column - 1], pixels[column]);
      const float far = std::max(pixels[column - 1], pixels[column]);
      if (far - near > kEdge * near && uniform() < share) {
        pixels[column] = near + uniform() * (far - near);
      }
    }
  }
}

void DepthCamera::blur(cv::Mat& depth) {
  cv::Mat error(depth.size(), CV_32FC1, cv::Scalar{0.0});
  if (params_.noise_m > 0.0) {
    rng_.fill(error, cv::RNG::NORMAL, 0.0, params_.noise_m * kPatch);
    cv::blur(error, error, {kPatch, kPatch});
  }
  for (int left = 0; params_.stripe_share > 0.0 && left < depth.cols;) {
    const int width = std::min(rng_.uniform(kStripeWidth[0], kStripeWidth[1]), depth.cols - left);
    if (uniform() < static_cast<float>(params_.stripe_share)) {
      error.colRange(left, left + width) +=
          rng_.gaussian(std::max(params_.noise_m, params_.step_m) * kStripeNoise);
    }
    left += width;
  }
  const auto step = static_cast<float>(params_.step_m);
  auto* pixels = depth.ptr<float>();
  const auto* errors = error.ptr<float>();
  for (std::size_t i = 0; i < depth.total(); ++i) {
    float inverse = 1.0F / pixels[i] - errors[i];
    if (step > 0.0F) {
      inverse = step * std::round(inverse / step);
    }
    pixels[i] = inverse > 0.0F ? 1.0F / inverse : kHole;  // a hole stays one
  }
}

}  // namespace cmn
