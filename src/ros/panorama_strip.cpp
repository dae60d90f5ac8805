// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/panorama_strip.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgproc.hpp>
#include <sensor_msgs/image_encodings.h>

namespace cmn {
namespace {

constexpr std::size_t kMostImages = 32;
constexpr double kBlackAt_m = 5.0;

cv::Mat brightness_of(const cv::Mat& depth_m) {
  cv::Mat depth = depth_m.clone();
  cv::patchNaNs(depth, kBlackAt_m);
  depth.setTo(kBlackAt_m, depth <= 0.0F);
  cv::Mat grey;
  depth.convertTo(grey, CV_8U, -255.0 / kBlackAt_m, 255.0);
  cv::Mat image;
  cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
  return image;
}

}  // namespace

cv::Mat panorama_of(const std::vector<std::pair<double, cv::Mat>>& images, double yaw_rad) {
  constexpr std::array<int, 4> kPlaceOfQuarter{1, 0, 3, 2};  // ahead, left, behind, right
  std::array<cv::Mat, 4> places;
  for (const auto& [image_yaw_rad, image] : images) {
    const int quarter = (nearest_quarter(wrap_angle(image_yaw_rad - yaw_rad)) + 4) % 4;
    places[static_cast<std::size_t>(kPlaceOfQuarter[static_cast<std::size_t>(quarter)])] = image;
  }
  if (std::any_of(places.begin(), places.end(), [](const cv::Mat& m) { return m.empty(); })) {
    return {};
  }
  for (cv::Mat& place : places) {
    if (place.rows != places[0].rows) {
      const double share = static_cast<double>(places[0].rows) / place.rows;
      cv::Mat scaled;
      cv::resize(place, scaled,
                 {std::max(1, static_cast<int>(share * place.cols)), places[0].rows});
      place = scaled;
    }
  }
  cv::Mat strip;
  cv::hconcat(places.data(), places.size(), strip);
  return strip;
}

PanoramaStrip::PanoramaStrip(ros::NodeHandle& nh) {
  pub_ = nh.advertise<sensor_msgs::Image>("panorama", 1, true);
  sub_ = nh.subscribe("image", 1, &PanoramaStrip::on_image, this);
}

void PanoramaStrip::on_image(const sensor_msgs::Image::ConstPtr& msg) {
  try {
    colour_ = cv_bridge::toCvCopy(msg, sensor_msgs::image_encodings::BGR8)->image;
  } catch (const cv_bridge::Exception& e) {
    ROS_WARN_STREAM_THROTTLE(5.0, "image: dropped, " << e.what());
  }
}

void PanoramaStrip::look(const cv::Mat& depth_m, double yaw_rad, bool is_complete,
                         const std_msgs::Header& header) {
  if (colour_) {
    images_.emplace_back(yaw_rad, *colour_);
  } else if (!depth_m.empty()) {
    images_.emplace_back(yaw_rad, brightness_of(depth_m));
  }
  if (images_.size() > kMostImages) {
    images_.erase(images_.begin());
  }
  if (!is_complete) {
    return;
  }
  const cv::Mat strip = panorama_of(images_, yaw_rad);
  if (!strip.empty()) {
    pub_.publish(
        cv_bridge::CvImage{header, sensor_msgs::image_encodings::BGR8, strip}.toImageMsg());
  }
  images_.clear();
}

}  // namespace cmn
