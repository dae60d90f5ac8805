// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/node.hpp"

#include <cstdlib>
#include <numeric>

#include <XmlRpcValue.h>

namespace cmn {
namespace {

void flatten(XmlRpc::XmlRpcValue& value, const std::string& path, ParamTree& tree) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeStruct:
      for (auto& entry : value) {
        flatten(entry.second, path.empty() ? entry.first : path + "/" + entry.first, tree);
      }
      break;
    case XmlRpc::XmlRpcValue::TypeBoolean:
      tree[path] = static_cast<bool>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      tree[path] = static_cast<double>(static_cast<int>(value));
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      tree[path] = static_cast<double>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeString:
      tree[path] = static_cast<std::string>(value);
      break;
    default:
      tree[path] = std::string{};
  }
}

}  // namespace

ParamTree read_param_server(const ros::NodeHandle& nh) {
  ParamTree tree;
  XmlRpc::XmlRpcValue root;
  if (nh.getParam(nh.getNamespace(), root)) {
    flatten(root, "", tree);
  }
  return tree;
}

void exit_with(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) {
    ROS_ERROR_STREAM(problem);
  }
  ros::shutdown();
  std::exit(EXIT_FAILURE);
}

void InputMonitor::received(const ros::Time& stamp) {
  ++count_;
  last_stamp_ = stamp;
  last_arrival_ = ros::Time::now();
}

void InputMonitor::dropped(const std::string& reason) {
  ++drops_[reason];
  ROS_WARN_STREAM_THROTTLE(5.0, name_ << ": dropped, " << reason);
}

std::uint64_t InputMonitor::drops() const {
  return std::accumulate(drops_.begin(), drops_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& drop) { return sum + drop.second; });
}

void InputMonitor::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Status = diagnostic_msgs::DiagnosticStatus;
  const ros::Time now = ros::Time::now();
  const bool is_silent_from_the_start = last_arrival_.isZero();
  if (is_silent_from_the_start) {
    status.summary(stale_after_s_ > 0.0 ? Status::WARN : Status::OK, "nothing received yet");
  } else if (stale_after_s_ > 0.0 && (now - last_arrival_).toSec() > stale_after_s_) {
    status.summary(Status::ERROR, "silent");
  } else if (drops() > drops_at_report_) {
    status.summary(Status::WARN, "some messages were dropped since the last report");
  } else {
    status.summary(Status::OK, "receiving");
  }
  status.add("received", count_);
  if (!last_report_.isZero() && now > last_report_) {
    status.add("rate [Hz]",
               static_cast<double>(count_ - count_at_report_) / (now - last_report_).toSec());
  }
  if (!is_silent_from_the_start) {
    status.add("age of the last [s]", (now - last_stamp_).toSec());
  }
  for (const auto& drop : drops_) {
    status.add("dropped: " + drop.first, drop.second);
  }
  last_report_ = now;
  count_at_report_ = count_;
  drops_at_report_ = drops();
}

}  // namespace cmn
