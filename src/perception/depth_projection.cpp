// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/depth_projection.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace cmn {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kPiece = 1024;        ///< points worked on at a time: they stay in the cache
constexpr std::size_t kMostSamples = 6000;  ///< about, to look for the floor among
constexpr std::uint32_t kFewest = 3;        ///< points that are no noise, however few there are
/// Neighbours in a row whose ranges differ by more belong to different surfaces; a wall that is
/// seen at less than 2 deg in an image of 640 columns is lost with the blur.
constexpr float kEdge = 0.1F;
constexpr std::size_t kBlur = 2;  ///< [pixels] width of the blur at an edge
/// From the densest neighbourhood's way: more would climb up a slope.
constexpr std::size_t kMostClimbed = 2;

/// atan2 to within 1e-4 rad, without branches, for the compiler to do several at once: the octants
/// are folded onto one another by signs. (Polynomial: Hastings 1955, sheet 11.) NaN for NaN.
float bearing_of(float x, float y) {
  constexpr auto kQuarter = static_cast<float>(kPi / 2.0);
  constexpr float kEighth = 0.5F * kQuarter;
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float difference = std::abs(ax - ay);
  const float ratio = (ax + ay - difference) / (ax + ay + difference);
  const float s = ratio * ratio;
  const float angle =
      ratio * (0.999866F + s * (-0.3302995F + s * (0.180141F + s * (-0.085133F + s * 0.0208351F))));
  const float first = kEighth - std::copysign(kEighth - angle, ax - ay);
  const float upper = kQuarter - std::copysign(kQuarter - first, x);
  return std::copysign(upper, y);
}

/// A number that grows like the logarithm of `square_m2` > 0: 32 a doubling of the range.
std::int32_t log_range_of(float square_m2) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &square_m2, sizeof bits);
  return bits >> 19;
}

/// The range at which that number begins.
float range_from(std::int32_t log_range) {
  const std::int32_t bits = log_range << 19;
  float square_m2 = 0.0F;
  std::memcpy(&square_m2, &bits, sizeof bits);
  return std::sqrt(square_m2);
}

/// The point of the floor under a camera, with the yaw of the optical axis.
Pose2 ground_pose(const Eigen::Isometry3d& T_robot_camera) {
  const Eigen::Vector3d p = T_robot_camera.translation();
  const Eigen::Vector3d axis = T_robot_camera.linear().col(2);
  return {p.x(), p.y(), std::atan2(axis.y(), axis.x())};
}

/// What turns a vector of the camera into one of the scan's frame.
Eigen::Matrix3f turn_to(const Pose2& T_robot_sensor, const Eigen::Isometry3d& T_robot_camera) {
  const Eigen::AngleAxisd back{-T_robot_sensor.yaw, Eigen::Vector3d::UnitZ()};
  return (back.toRotationMatrix() * T_robot_camera.linear()).cast<float>();
}

/// The points of a depth image, relative to the camera, in the axes of the scan.
class ImagePoints {
 public:
  ImagePoints(const DepthImage& image, const Eigen::Matrix3f& turn)
      : image_{image}, turn_{turn}, right_(static_cast<std::size_t>(image.camera.width)) {
    for (std::size_t u = 0; u < right_.size(); ++u) {
      right_[u] = static_cast<float>((static_cast<double>(u) - image.camera.cx) / image.camera.fx);
    }
  }
  std::size_t width() const { return right_.size(); }
  std::size_t height() const { return static_cast<std::size_t>(image_.camera.height); }
  bool is_organised() const { return true; }

  Eigen::Vector3f at(std::size_t u, std::size_t v) const {
    const float depth = image_.depth_m.ptr<float>(static_cast<int>(v))[u];
    return depth > 0.0F ? Eigen::Vector3f{depth * turn_ * ray(u, v)}
                        : Eigen::Vector3f::Constant(kNan);
  }
  void read(std::size_t v, std::size_t first, std::size_t count, float* x, float* y,
            float* z) const {
    const float* depths = image_.depth_m.ptr<float>(static_cast<int>(v)) + first;
    const float* right = right_.data() + first;
    const Eigen::Vector3f across = turn_.col(0);
    const Eigen::Vector3f middle = turn_ * ray(0, v) - right_[0] * across;
    const float ax = across.x(), ay = across.y(), az = across.z();
    const float mx = middle.x(), my = middle.y(), mz = middle.z();
    for (std::size_t i = 0; i < count; ++i) {
      const float depth = depths[i] > 0.0F ? depths[i] : kNan;
      x[i] = depth * (mx + ax * right[i]);
      y[i] = depth * (my + ay * right[i]);
      z[i] = depth * (mz + az * right[i]);
    }
  }

 private:
  Eigen::Vector3f ray(std::size_t u, std::size_t v) const {
    return {right_[u],
            static_cast<float>((static_cast<double>(v) - image_.camera.cy) / image_.camera.fy),
            1.0F};
  }
  const DepthImage& image_;
  Eigen::Matrix3f turn_;
  std::vector<float> right_;  ///< of a column, at depth 1
};

/// The same of a cloud.
class CloudPoints {
 public:
  CloudPoints(const PointCloudView& cloud, const Eigen::Matrix3f& turn)
      : cloud_{cloud}, turn_{turn} {}
  std::size_t width() const { return cloud_.width; }
  std::size_t height() const { return cloud_.height; }
  bool is_organised() const { return cloud_.height > 1; }

  Eigen::Vector3f at(std::size_t u, std::size_t v) const {
    const std::uint8_t* point = cloud_.data + v * cloud_.row_step + u * cloud_.point_step;
    return turn_ * Eigen::Vector3f{coordinate_of(point, cloud_.x), coordinate_of(point, cloud_.y),
                                   coordinate_of(point, cloud_.z)};
  }
  void read(std::size_t v, std::size_t first, std::size_t count, float* x, float* y,
            float* z) const {
    const std::uint8_t* point = cloud_.data + v * cloud_.row_step + first * cloud_.point_step;
    const bool are_floats = !cloud_.x.is_double && !cloud_.y.is_double && !cloud_.z.is_double;
    for (std::size_t i = 0; i < count; ++i, point += cloud_.point_step) {
      if (are_floats) {
        std::memcpy(x + i, point + cloud_.x.offset, sizeof(float));
        std::memcpy(y + i, point + cloud_.y.offset, sizeof(float));
        std::memcpy(z + i, point + cloud_.z.offset, sizeof(float));
      } else {
        x[i] = coordinate_of(point, cloud_.x);
        y[i] = coordinate_of(point, cloud_.y);
        z[i] = coordinate_of(point, cloud_.z);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float px = x[i], py = y[i], pz = z[i];
      x[i] = turn_(0, 0) * px + turn_(0, 1) * py + turn_(0, 2) * pz;
      y[i] = turn_(1, 0) * px + turn_(1, 1) * py + turn_(1, 2) * pz;
      z[i] = turn_(2, 0) * px + turn_(2, 1) * py + turn_(2, 2) * pz;
    }
  }

 private:
  const PointCloudView& cloud_;
  Eigen::Matrix3f turn_;
};

/// Least and greatest bearing of the image in the scan's frame; all of them when it looks up or
/// down.
std::array<double, 2> bearings_of(const CameraModel& camera, const Eigen::Matrix3f& turn) {
  const Eigen::Vector3f down = turn.row(2).transpose();  // or up, in the camera's frame
  if (std::abs(down.z()) > 1e-6F) {
    const double u = static_cast<double>(down.x() / down.z()) * camera.fx + camera.cx;
    const double v = static_cast<double>(down.y() / down.z()) * camera.fy + camera.cy;
    if (u > -1.0 && v > -1.0 && u < camera.width && v < camera.height) {
      return {-kPi, kPi};
    }
  }
  std::array<double, 2> range{kPi, -kPi};
  const auto look_at = [&](int u, int v) {
    const Eigen::Vector3f ray{static_cast<float>((u - camera.cx) / camera.fx),
                              static_cast<float>((v - camera.cy) / camera.fy), 1.0F};
    const Eigen::Vector3d p = (turn * ray).cast<double>();
    const double bearing = std::atan2(p.y(), p.x());
    range = {std::min(range[0], bearing), std::max(range[1], bearing)};
  };
  for (int u = 0; u < camera.width; ++u) {
    look_at(u, 0);
    look_at(u, camera.height - 1);
  }
  for (int v = 0; v < camera.height; ++v) {
    look_at(0, v);
    look_at(camera.width - 1, v);
  }
  return range;
}

/// A scan of no ranges yet, with bearings at whole increments from `range[0]` to `range[1]`.
RangeScan layout_of(double increment_rad, std::array<double, 2> range, const DepthParams& params) {
  RangeScan scan;
  const double most = std::floor(2.0 * kPi / increment_rad + 1e-9);
  const double first = std::floor(range[0] / increment_rad);
  const double beams = std::min(most, std::ceil(range[1] / increment_rad) - first + 1.0);
  scan.angle_increment_rad = increment_rad;
  scan.angle_min_rad = first * increment_rad;
  scan.range_max_m = params.range_max_m;
  scan.source = ObservationSource::kDepth;
  scan.ranges_m.assign(static_cast<std::size_t>(beams), kNan);
  scan.sights.assign(scan.ranges_m.size(), {});
  return scan;
}

}  // namespace

RangeScan DepthProjector::scan(const DepthImage& image) {
  const double pixel_rad = 1.2 / std::min(image.camera.fx, image.camera.fy);
  const double increment_rad = std::max(params_.increment_deg * kPi / 180.0, pixel_rad);
  const Pose2 ground = ground_pose(image.T_robot_camera);
  const Eigen::Matrix3f turn = turn_to(ground, image.T_robot_camera);
  RangeScan scan = layout_of(increment_rad, bearings_of(image.camera, turn), params_);
  scan.stamp_s = image.stamp_s;
  scan.T_robot_sensor = ground;
  height_m_ = static_cast<float>(image.T_robot_camera.translation().z());
  return scan_of(ImagePoints{image, turn}, std::move(scan));
}

RangeScan DepthProjector::scan(const PointCloudView& cloud) {
  const Eigen::Vector3d origin = cloud.T_robot_camera.translation();
  const Pose2 ground{origin.x(), origin.y(), 0.0};
  RangeScan scan = layout_of(params_.increment_deg * kPi / 180.0, {-kPi, kPi}, params_);
  scan.stamp_s = cloud.stamp_s;
  scan.T_robot_sensor = ground;
  height_m_ = static_cast<float>(origin.z());
  return scan_of(CloudPoints{cloud, turn_to(ground, cloud.T_robot_camera)}, std::move(scan));
}

template <class Source>
RangeScan DepthProjector::scan_of(const Source& source, RangeScan scan) {
  report_ = {};
  const FloorPlane plane = floor_of(source);
  report_.floor = floor_.source();
  report_.plane = plane;
  const std::int32_t nearest =
      log_range_of(static_cast<float>(params_.range_min_m * params_.range_min_m));
  range_bins_ = static_cast<std::size_t>(
      log_range_of(static_cast<float>(params_.range_max_m * params_.range_max_m)) - nearest + 3);
  bins_.assign((scan.ranges_m.size() + 2) * range_bins_ + 1, Bin{});
  for (auto* buffer : {&x_, &y_, &z_, &square_m2_, &bearing_}) {
    buffer->resize(kPiece);
  }
  bin_.resize(kPiece);
  in_way_.resize(kPiece);
  for (std::size_t v = 0; v < source.height(); ++v) {
    for (std::size_t first = 0; first < source.width(); first += kPiece) {
      const std::size_t count = std::min(kPiece, source.width() - first);
      source.read(v, first, count, x_.data(), y_.data(), z_.data());
      sort_in(count, source.is_organised(), scan, plane);
    }
  }
  report_.unusable = source.width() * source.height() - report_.points;
  read_out(scan);
  return scan;
}

template <class Source>
FloorPlane DepthProjector::floor_of(const Source& source) {
  candidates_.clear();
  const double points = static_cast<double>(source.width()) * static_cast<double>(source.height());
  const double every = std::max(1.0, points / static_cast<double>(kMostSamples));
  const bool is_image = source.height() > 1;
  const auto step_v = static_cast<std::size_t>(is_image ? std::ceil(std::sqrt(every)) : 1.0);
  const auto step_u = static_cast<std::size_t>(is_image ? std::ceil(std::sqrt(every)) : every);
  for (std::size_t v = step_v / 2; v < source.height(); v += step_v) {
    for (std::size_t u = step_u / 2; u < source.width(); u += step_u) {
      Eigen::Vector3f p = source.at(u, v);
      p.z() += height_m_;
      if (floor_.is_candidate(p)) {
        candidates_.push_back(p);
      }
    }
  }
  return floor_.fit(candidates_);
}

void DepthProjector::sort_in(std::size_t count, bool is_organised, const RangeScan& layout,
                             const FloorPlane& plane) {
  measure(count, layout, plane);
  const auto range_min_m = static_cast<float>(params_.range_min_m);
  const float least_m2 = range_min_m * range_min_m;
  const std::int32_t nearest = log_range_of(least_m2);
  const auto beams = static_cast<std::int32_t>(layout.ranges_m.size());
  const auto range_bins = static_cast<std::int32_t>(range_bins_);
  const std::int32_t farthest = range_bins - 2;
  const auto none = static_cast<std::int32_t>(bins_.size() - 1);
  const auto lowest_m = static_cast<float>(params_.lowest_m);
  const auto highest_m = static_cast<float>(params_.highest_m);
  std::int32_t points = 0;
  // Without branches, for the compiler to do several at once.
  for (std::size_t i = 0; i < count; ++i) {
    const float square_m2 = square_m2_[i];
    const unsigned is_point = unsigned{square_m2 >= least_m2} & unsigned{square_m2 < kInfinity};
    const unsigned is_in_band = unsigned{z_[i] > -lowest_m} & unsigned{z_[i] < highest_m};
    const std::int32_t log_range = log_range_of(square_m2) - nearest + 1;
    const auto beam = static_cast<std::int32_t>(bearing_[i]);
    // All around, half a bin before the first is last.
    const std::int32_t row = beam > beams ? beam - beams : beam;
    const std::int32_t bin = row * range_bins + std::min(log_range, farthest);
    const unsigned is_in_way = unsigned{z_[i] > lowest_m} & unsigned{log_range <= farthest};
    points += static_cast<std::int32_t>(is_point);
    bin_[i] = (is_point & is_in_band) != 0U ? bin : none;
    in_way_[i] = is_in_way;
  }
  report_.points += static_cast<std::size_t>(points);
  constexpr float kGap = (1.0F + kEdge) * (1.0F + kEdge);
  if (is_organised) {
    std::int32_t flying = 0;
    for (std::size_t i = kBlur; i + kBlur < count; ++i) {
      const float here = square_m2_[i];
      const float before = square_m2_[i - kBlur];
      const float after = square_m2_[i + kBlur];
      const float farther = kGap * here;
      const bool is_flying = ((here > kGap * before) & (after > farther)) |
                             ((here > kGap * after) & (before > farther));
      flying += is_flying;
      bin_[i] = is_flying ? none : bin_[i];
    }
    report_.flying += static_cast<std::size_t>(flying);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Bin& bin = bins_[static_cast<std::size_t>(bin_[i])];
    bin.square_sum_m2 += in_way_[i] != 0 ? square_m2_[i] : 0.0F;
    bin.obstacles += in_way_[i];
    ++bin.points;
  }
}

void DepthProjector::measure(std::size_t count, const RangeScan& layout, const FloorPlane& plane) {
  const auto per_rad = static_cast<float>(1.0 / layout.angle_increment_rad);
  // Half a bin more, for rounding, and one more, since there is a row of none before the first.
  const float from = 1.5F - static_cast<float>(layout.angle_min_rad) * per_rad;
  const float last = static_cast<float>(layout.ranges_m.size()) + 1.5F;
  const float slope_x = plane.slope.x(), slope_y = plane.slope.y();
  const float height_m = height_m_ - plane.offset_m;
  for (std::size_t i = 0; i < count; ++i) {
    square_m2_[i] = x_[i] * x_[i] + y_[i] * y_[i];
    z_[i] += height_m - slope_x * x_[i] - slope_y * y_[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float bearing = from + per_rad * bearing_of(x_[i], y_[i]);
    const float at_least = bearing > 1.0F ? bearing : 1.0F;  // of NaN, too
    bearing_[i] = at_least < last ? at_least : last;
  }
}

void DepthProjector::read_out(RangeScan& scan) {
  const std::int32_t nearest =
      log_range_of(static_cast<float>(params_.range_min_m * params_.range_min_m));
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const Bin* before = bins_.data() + beam * range_bins_;
    const Bin* own = before + range_bins_;
    const Bin* after = own + range_bins_;
    std::uint32_t points = 0;
    for (std::size_t r = 0; r < range_bins_; ++r) {
      points += own[r].points;
    }
    const auto enough = std::max(
        kFewest, static_cast<std::uint32_t>(params_.least_share * static_cast<double>(points)));
    const auto around = [&](std::size_t r, auto&& count) {
      return count(before[r - 1]) + count(before[r]) + count(before[r + 1]) + count(own[r - 1]) +
             count(own[r]) + count(own[r + 1]) + count(after[r - 1]) + count(after[r]) +
             count(after[r + 1]);
    };
    const auto obstacles = [](const Bin& bin) { return bin.obstacles; };
    const auto any = [](const Bin& bin) { return bin.points; };
    RangeScan::Sight& sight = scan.sights[beam];
    bool has_seen = false;
    std::size_t hit = 0;
    for (std::size_t r = 1; r + 1 < range_bins_ && hit == 0; ++r) {
      if (any(own[r]) == 0) {
        continue;
      }
      if (own[r].obstacles > 0) {
        if (around(r, obstacles) >= enough) {
          hit = r;
        } else {
          report_.isolated += own[r].obstacles;
        }
      }
      if (hit == r || around(r, any) >= enough) {
        const float from_m = range_from(nearest + static_cast<std::int32_t>(r) - 1);
        sight.from_m = has_seen ? sight.from_m : from_m;
        sight.to_m = from_m;
        has_seen = true;
      }
    }
    if (hit != 0) {
      for (std::size_t climbed = 0; climbed < kMostClimbed && hit + 2 < range_bins_ &&
                                    own[hit + 1].obstacles > own[hit].obstacles;
           ++climbed) {
        ++hit;
      }
      scan.ranges_m[beam] =
          std::sqrt(own[hit].square_sum_m2 / static_cast<float>(own[hit].obstacles));
    } else if (has_seen) {
      scan.ranges_m[beam] = kInfinity;
    }
  }
}

}  // namespace cmn
