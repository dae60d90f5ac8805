// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/camera_publisher.hpp"

#include "coarse_map_nav/ros/camera_conversions.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

namespace cmn {

CameraPublisher::CameraPublisher(ros::NodeHandle& nh, const SensorFrameParams& frames,
                                 const CameraModel& color)
    : frames_{frames}, color_{color} {
  if (!frames.depth.empty()) {
    info_pub_ = nh.advertise<sensor_msgs::CameraInfo>("camera_info", 2);
    depth_pub_ = nh.advertise<sensor_msgs::Image>("depth/image", 2);
    cloud_pub_ = nh.advertise<sensor_msgs::PointCloud2>("points", 2);
  }
  if (!frames.color.empty()) {
    image_info_pub_ = nh.advertise<sensor_msgs::CameraInfo>("image/camera_info", 2);
    image_pub_ = nh.advertise<sensor_msgs::Image>("image", 2);
  }
}

void CameraPublisher::publish(SceneSensors& sensors, const Pose2& T_world_robot,
                              const ros::Time& stamp) {
  std_msgs::Header header;
  header.stamp = stamp;
  // First, so that it is there when the depth of the same moment is looked at.
  if (image_pub_.getNumSubscribers() > 0 || image_info_pub_.getNumSubscribers() > 0) {
    header.frame_id = frames_.color;
    image_info_pub_.publish(message_of(color_, header));
    image_pub_.publish(cv_bridge::CvImage{header, sensor_msgs::image_encodings::BGR8,
                                          sensors.color(T_world_robot, stamp.toSec()).bgr}
                           .toImageMsg());
  }
  const bool is_cloud_wanted = cloud_pub_.getNumSubscribers() > 0;
  const bool is_image_wanted =
      depth_pub_.getNumSubscribers() > 0 || info_pub_.getNumSubscribers() > 0;
  if (is_cloud_wanted || is_image_wanted) {
    header.frame_id = frames_.depth;
    const DepthImage depth = sensors.depth(T_world_robot, stamp.toSec());
    if (is_image_wanted) {
      info_pub_.publish(message_of(depth.camera, header));
      depth_pub_.publish(message_of(depth, header));
    }
    if (is_cloud_wanted) {
      cloud_pub_.publish(cloud_of(depth, header));
    }
  }
}

}  // namespace cmn
