// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The colour of a point of a surface.
#pragma once

#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <opencv2/core.hpp>

namespace cmn {

/// The texel at a hit, BGRA, repeating the texture beyond its borders. The material must have one.
cv::Vec4b texel_at(const MeshScene& scene, const Hit& hit);

/// BGR in sRGB: the texel where the material has a texture, else the material's colour.
cv::Vec3b colour_at(const MeshScene& scene, const Hit& hit);

/// Any picture as a texture: CV_8UC4, BGRA; sides above `longest` are scaled down to it. Empty when
/// the picture is, or has another depth than 8 or 16 bits.
cv::Mat texture_of(const cv::Mat& picture, int longest = 1024);

}  // namespace cmn
