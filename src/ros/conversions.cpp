// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/conversions.hpp"

#include "coarse_map_nav/localization/localizer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cmn {
namespace {

/// Finer than any sensor; a beam's number still fits an int.
constexpr float kLeastIncrement_rad = 1e-6F;

bool is_finite(double x, double y) { return std::isfinite(x) && std::isfinite(y); }

std::optional<Pose2> planar_pose(double x, double y, const geometry_msgs::Quaternion& q) {
  const std::optional<double> yaw = yaw_of(q);
  if (!yaw || !is_finite(x, y)) {
    return std::nullopt;
  }
  return Pose2{x, y, *yaw};
}

/// A float of a message as the decimal number it was meant to be: 0.4F is 0.4 again.
double widened(float value) { return std::round(static_cast<double>(value) * 1e6) / 1e6; }

/// A cell size that lengths can be divided by.
bool is_resolution(float value) { return std::isfinite(value) && widened(value) > 0.0; }

/// On the map, or at most a cell beside it.
bool is_about(const CoarseMap& map, Point2 p_cells) {
  return p_cells.x >= -1.0 && p_cells.y >= -1.0 && p_cells.x <= map.width() + 1.0 &&
         p_cells.y <= map.height() + 1.0;
}

}  // namespace

geometry_msgs::Quaternion quaternion_of(double yaw_rad) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(0.5 * yaw_rad);
  q.w = std::cos(0.5 * yaw_rad);
  return q;
}

std::optional<double> yaw_of(const geometry_msgs::Quaternion& q) {
  const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!std::isfinite(square) || square < 1e-6) {
    return std::nullopt;
  }
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y) / square,
                    1.0 - 2.0 * (q.y * q.y + q.z * q.z) / square);
}

geometry_msgs::Pose pose_message(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation = quaternion_of(pose.yaw);
  return message;
}

std::optional<Pose2> pose_of(const geometry_msgs::Pose& pose) {
  return planar_pose(pose.position.x, pose.position.y, pose.orientation);
}

geometry_msgs::Transform transform_message(const Pose2& pose) {
  geometry_msgs::Transform message;
  message.translation.x = pose.x;
  message.translation.y = pose.y;
  message.rotation = quaternion_of(pose.yaw);
  return message;
}

std::optional<Pose2> pose_of(const geometry_msgs::Transform& transform) {
  return planar_pose(transform.translation.x, transform.translation.y, transform.rotation);
}

nav_msgs::MapMetaData info_of(const CoarseMap& map) {
  nav_msgs::MapMetaData info;
  info.resolution = static_cast<float>(map.resolution());
  info.width = static_cast<std::uint32_t>(map.width());
  info.height = static_cast<std::uint32_t>(map.height());
  info.origin = pose_message(map.T_map_grid());
  return info;
}

nav_msgs::OccupancyGrid grid_message(const CoarseMap& map) {
  nav_msgs::OccupancyGrid grid;
  grid.info = info_of(map);
  grid.data.reserve(map.occupied().size());
  for (const std::uint8_t occupied : map.occupied().values()) {
    grid.data.push_back(occupied == 0 ? 0 : 100);
  }
  return grid;
}

std::optional<CoarseMap> map_of(const nav_msgs::OccupancyGrid& grid, std::string& why) {
  const auto cells = static_cast<std::uint64_t>(grid.info.width) * grid.info.height;
  const std::optional<Pose2> origin = pose_of(grid.info.origin);
  if (cells == 0 || cells != grid.data.size()) {
    why = "the map says " + std::to_string(grid.info.width) + " x " +
          std::to_string(grid.info.height) + " cells and holds " + std::to_string(grid.data.size());
  } else if (!is_resolution(grid.info.resolution)) {
    why = "the map's resolution " + std::to_string(grid.info.resolution) + " is no cell size";
  } else if (!origin) {
    why = "the map's origin is not a pose";
  } else {
    Grid<std::uint8_t> occupied{static_cast<int>(grid.info.width),
                                static_cast<int>(grid.info.height)};
    for (std::size_t i = 0; i < occupied.size(); ++i) {
      occupied[i] = grid.data[i] < 0 || grid.data[i] >= 50 ? 1 : 0;
    }
    CoarseMap map{std::move(occupied), widened(grid.info.resolution), *origin};
    if (map.free_count() > 0) {
      return map;
    }
    why = "the map has no free cell";
  }
  return std::nullopt;
}

coarse_map_nav::LocalOccupancy message_of(const LocalOccupancy& local, const std_msgs::Header& h) {
  coarse_map_nav::LocalOccupancy message;
  message.header = h;
  message.resolution = static_cast<float>(local.resolution);
  message.size = static_cast<std::uint32_t>(local.size);
  message.occupancy = local.occupancy;
  message.confidence = local.confidence;
  message.source = static_cast<std::uint8_t>(local.source);
  if (local.heading_drift) {
    message.aligned_since.fromSec(local.heading_drift->since_s);
    message.heading_drift = static_cast<float>(local.heading_drift->rad);
  }
  return message;
}

nav_msgs::OccupancyGrid grid_message(const LocalOccupancy& local, const std_msgs::Header& header) {
  constexpr double kShown_m = 6.0;
  const int margin =
      std::max(0, static_cast<int>(0.5 * (local.size - std::floor(kShown_m / local.resolution))));
  const int side = local.size - 2 * margin;
  nav_msgs::OccupancyGrid grid;
  grid.header = header;
  grid.info.resolution = static_cast<float>(local.resolution);
  grid.info.width = grid.info.height = static_cast<std::uint32_t>(side);
  const double corner_m = -0.5 * side * local.resolution;
  grid.info.origin = pose_message({corner_m, corner_m, 0.0});
  for (int iy = margin; iy < margin + side; ++iy) {
    for (int ix = margin; ix < margin + side; ++ix) {
      const std::size_t i = local.index_of(ix, iy);
      const bool is_known = local.confidence[i] > 0.0F;
      grid.data.push_back(is_known ? static_cast<std::int8_t>(100.0F * local.occupancy[i]) : -1);
    }
  }
  return grid;
}

std::optional<LocalOccupancy> local_occupancy_of(const coarse_map_nav::LocalOccupancy& msg,
                                                 std::string& why) {
  const auto cells = static_cast<std::uint64_t>(msg.size) * msg.size;
  if (cells == 0 || msg.occupancy.size() != cells || msg.confidence.size() != cells) {
    why = "it says " + std::to_string(msg.size) + " cells a side and holds " +
          std::to_string(msg.occupancy.size()) + " values and " +
          std::to_string(msg.confidence.size()) + " confidences";
    return std::nullopt;
  }
  if (!is_resolution(msg.resolution)) {
    why = "it has no cell size";
    return std::nullopt;
  }
  for (std::size_t i = 0; i < cells; ++i) {
    const float p = msg.occupancy[i];
    const float c = msg.confidence[i];
    if (!(p >= 0.0F && p <= 1.0F) || !(c >= 0.0F) || !std::isfinite(c)) {
      why = "it holds a value that is no probability or no confidence";
      return std::nullopt;
    }
  }
  if (!std::isfinite(msg.heading_drift)) {
    why = "its heading_drift is no angle";
    return std::nullopt;
  }
  LocalOccupancy local;
  local.stamp_s = msg.header.stamp.toSec();
  local.resolution = widened(msg.resolution);
  local.size = static_cast<int>(msg.size);
  local.occupancy = msg.occupancy;
  local.confidence = msg.confidence;
  local.source = static_cast<ObservationSource>(msg.source);
  if (!msg.aligned_since.isZero()) {
    local.heading_drift =
        HeadingDrift{static_cast<double>(msg.heading_drift), msg.aligned_since.toSec()};
  }
  return local;
}

std::string fault_of(const sensor_msgs::LaserScan& scan) {
  if (scan.ranges.empty()) {
    return "the scan has no ranges";
  }
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment) ||
      std::abs(scan.angle_increment) < kLeastIncrement_rad) {
    return "the scan's angles are no angles";
  }
  if (!std::isfinite(scan.range_min) || !std::isfinite(scan.range_max) || scan.range_min < 0.0F ||
      !(scan.range_max > scan.range_min)) {
    return "the scan's range_min and range_max are no interval";
  }
  return "";
}

RangeScan scan_of(const sensor_msgs::LaserScan& scan, const Pose2& T_robot_sensor) {
  RangeScan result;
  result.stamp_s = scan.header.stamp.toSec();
  result.angle_min_rad = static_cast<double>(scan.angle_min);
  result.angle_increment_rad = static_cast<double>(scan.angle_increment);
  result.range_min_m = static_cast<double>(scan.range_min);
  result.range_max_m = static_cast<double>(scan.range_max);
  result.ranges_m = scan.ranges;
  result.T_robot_sensor = T_robot_sensor;
  return result;
}

coarse_map_nav::Belief message_of(const Localization& at, const CoarseMap& map) {
  coarse_map_nav::Belief message;
  message.info = info_of(map);
  message.layers = static_cast<std::uint8_t>(kHeadings.size());
  message.probability.reserve(kHeadings.size() * map.occupied().size());
  for (const Heading h : kHeadings) {
    for (std::size_t i = 0; i < map.occupied().size(); ++i) {
      message.probability.push_back(static_cast<float>(at.belief(h, map.occupied().cell_at(i))));
    }
  }
  message.entropy = static_cast<float>(entropy(at.belief));
  message.confidence = static_cast<float>(at.confidence);
  message.converged = static_cast<std::uint8_t>(at.is_converged);
  message.estimate = pose_message(pose_in_map(map, at));
  message.most_probable = static_cast<std::uint32_t>(
      static_cast<std::size_t>(index(at.estimate.heading)) * map.occupied().size() +
      map.occupied().index_of(at.estimate.cell));
  message.scale = static_cast<float>(at.scale);
  message.axes_yaw = static_cast<float>(at.axes_yaw_rad);
  return message;
}

std::optional<ReceivedBelief> belief_of(const coarse_map_nav::Belief& msg, const CoarseMap& map,
                                        std::string& why) {
  const std::size_t cells = map.occupied().size();
  if (msg.layers != kHeadings.size() || msg.info.width != static_cast<std::uint32_t>(map.width()) ||
      msg.info.height != static_cast<std::uint32_t>(map.height()) ||
      msg.probability.size() != kHeadings.size() * cells) {
    why = "it is not one over four headings and the cells of this map";
    return std::nullopt;
  }
  ReceivedBelief received;
  received.belief = Belief{map.width(), map.height()};
  for (const Heading h : kHeadings) {
    const std::size_t first = static_cast<std::size_t>(index(h)) * cells;
    for (std::size_t i = 0; i < cells; ++i) {
      const auto p = static_cast<double>(msg.probability[first + i]);
      if (!(p >= 0.0)) {
        why = "it holds a value that is no probability";
        return std::nullopt;
      }
      received.belief.set_weight(h, map.occupied().cell_at(i), p);
    }
  }
  const std::optional<Pose2> T_map_robot = pose_of(msg.estimate);
  if (T_map_robot) {
    const Pose2 T_grid_robot = inverse(map.T_map_grid()) * *T_map_robot;
    received.position_cells = (1.0 / map.resolution()) * T_grid_robot.position();
    received.yaw_rad = T_grid_robot.yaw;
  }
  if (!received.belief.normalise() || !T_map_robot || !is_about(map, received.position_cells) ||
      msg.most_probable >= kHeadings.size() * cells) {
    why = "it holds no distribution or its estimate lies off the map";
    return std::nullopt;
  }
  received.confidence = static_cast<double>(msg.confidence);
  received.scale = static_cast<double>(msg.scale);
  received.axes_yaw_rad = static_cast<double>(msg.axes_yaw);
  if (!std::isfinite(received.confidence) || !(received.scale > 0.0) ||
      !std::isfinite(received.scale) || !std::isfinite(received.axes_yaw_rad)) {
    why = "its confidence, scale or axes are no numbers";
    return std::nullopt;
  }
  received.is_converged = msg.converged != 0;
  received.estimate.heading = kHeadings[msg.most_probable / cells];
  received.estimate.cell = map.occupied().cell_at(msg.most_probable % cells);
  received.estimate.probability =
      received.belief(received.estimate.heading, received.estimate.cell);
  return received;
}

coarse_map_nav::DiscreteAction message_of(const Action& action, std::uint32_t id,
                                          const std_msgs::Header& header) {
  coarse_map_nav::DiscreteAction message;
  message.header = header;
  message.id = id;
  message.type = static_cast<std::uint8_t>(action.type);
  message.distance = static_cast<float>(action.distance_m);
  message.axes_yaw = static_cast<float>(action.axes_yaw_rad);
  return message;
}

coarse_map_nav::MotionResult message_of(const MotionResult& result,
                                        const std_msgs::Header& header) {
  coarse_map_nav::MotionResult message;
  message.header = header;
  message.id = result.action_id;
  message.outcome = static_cast<std::uint8_t>(result.outcome);
  message.displacement.x = result.T_start_end.x;
  message.displacement.y = result.T_start_end.y;
  message.displacement.theta = result.T_start_end.yaw;
  return message;
}

coarse_map_nav::NavigationStatus message_of(const Decision& decision, double confidence,
                                            const Planner* planner,
                                            const std_msgs::Header& header) {
  coarse_map_nav::NavigationStatus message;
  message.header = header;
  message.state = static_cast<std::uint8_t>(decision.state);
  message.text = decision.text;
  message.confidence = static_cast<float>(confidence);
  message.distance_to_go = static_cast<float>(decision.distance_to_go_m);
  if (planner != nullptr) {
    message.actions = static_cast<std::uint32_t>(planner->actions());
    message.pivots = static_cast<std::uint32_t>(planner->pivots());
  }
  return message;
}

nav_msgs::Path message_of(const std::vector<Cell>& path, const CoarseMap& map,
                          const std_msgs::Header& header) {
  nav_msgs::Path message;
  message.header = header;
  for (const Cell c : path) {
    const Point2 p = map.center_of(c);
    geometry_msgs::PoseStamped pose;
    pose.header = header;
    pose.pose = pose_message({p.x, p.y, 0.0});
    message.poses.push_back(pose);
  }
  return message;
}

sensor_msgs::LaserScan message_of(const RangeScan& scan, const std_msgs::Header& header,
                                  double period_s) {
  sensor_msgs::LaserScan message;
  message.header = header;
  message.angle_min = static_cast<float>(scan.angle_min_rad);
  message.angle_increment = static_cast<float>(scan.angle_increment_rad);
  message.angle_max = static_cast<float>(scan.angle_min_rad +
                                         scan.angle_increment_rad *
                                             (static_cast<double>(scan.ranges_m.size()) - 1.0));
  message.scan_time = static_cast<float>(period_s);
  message.range_min = static_cast<float>(scan.range_min_m);
  message.range_max = static_cast<float>(scan.range_max_m);
  message.ranges = scan.ranges_m;
  return message;
}

}  // namespace cmn
