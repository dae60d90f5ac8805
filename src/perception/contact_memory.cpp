// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/contact_memory.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

constexpr double kBehindTheBumper_m = 0.05;

}  // namespace

void ContactMemory::drive_to(Point2 position) {
  driven_m_ += last_ ? norm(position - *last_) : 0.0;
  last_ = position;
}

void ContactMemory::forget() {
  contacts_.clear();
  last_.reset();
}

void ContactMemory::add(const Pose2& T_odom_robot) {
  drive_to(T_odom_robot.position());
  contacts_.push_back({T_odom_robot * Point2{radius_m_ + kBehindTheBumper_m, 0.0}, driven_m_});
  if (contacts_.size() > kMost) {
    contacts_.pop_front();
  }
}

void ContactMemory::mark(LocalOccupancy& local, const Pose2& T_odom_robot) {
  drive_to(T_odom_robot.position());
  while (!contacts_.empty() && driven_m_ - contacts_.front().driven_m > kRemembered_m) {
    contacts_.pop_front();
  }
  const auto is_refuted = [&](const Contact& contact) {
    return norm(contact.position - T_odom_robot.position()) < radius_m_;
  };
  contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(), is_refuted), contacts_.end());
  const Pose2 T_robot_odom = inverse(T_odom_robot);
  const auto column_of = [&](double metres) {
    return std::floor(metres / local.resolution + 0.5 * local.size);
  };
  for (const Contact& contact : contacts_) {
    const Point2 p = T_robot_odom * contact.position;
    const double x = column_of(p.x);
    const double y = column_of(p.y);
    if (x >= 0.0 && y >= 0.0 && x < local.size && y < local.size) {
      const std::size_t i = local.index_of(static_cast<int>(x), static_cast<int>(y));
      local.occupancy[i] = 1.0F;
      local.confidence[i] = 1.0F;
    }
  }
}

}  // namespace cmn
