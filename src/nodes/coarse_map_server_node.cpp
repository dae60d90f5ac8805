// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Publishes the drawing, latched and as a service, and its named places for rviz.

#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/mapping/regions.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <exception>
#include <string>
#include <utility>

#include <nav_msgs/GetMap.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

namespace {

visualization_msgs::MarkerArray markers_of(const cmn::MapPlaces& places,
                                           const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  for (const cmn::Place& place : places.places) {
    visualization_msgs::Marker marker;
    marker.header = header;
    marker.ns = "places";
    marker.id = static_cast<int>(array.markers.size());
    marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
    marker.pose = cmn::pose_message({place.map.x, place.map.y, 0.0});
    marker.scale.z = 0.28;
    marker.color.r = 0.1F;
    marker.color.g = 0.3F;
    marker.color.b = 0.6F;
    marker.color.a = 0.9F;
    marker.text = place.name;
    array.markers.push_back(marker);
  }
  return array;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "coarse_map_server");
  ros::NodeHandle nh;
  const auto params =
      cmn::load_params_or_exit<cmn::NodeParams<cmn::MapServerParams>>(ros::NodeHandle("~"));
  if (params.own.map.empty()) {
    cmn::exit_with({"map: name the file of the drawing, for example _map:=maps/home.yaml"});
  }

  nav_msgs::OccupancyGrid grid;
  cmn::MapPlaces places;
  try {
    cmn::CoarseMap map = cmn::read_map(params.own.map, params.own.resolution);
    if (params.own.close_pockets) {
      cmn::LargestRegion region = cmn::largest_region(map);
      ROS_INFO_STREAM_COND(region.closed_cells > 0,
                           region.closed_cells << " free cells in closed pockets are left out");
      map = std::move(region.map);
    }
    grid = cmn::grid_message(map);
    places = cmn::read_places(params.own.map);
  } catch (const std::exception& e) {
    cmn::exit_with({e.what()});
  }
  grid.header.frame_id = params.frames.map;
  grid.header.stamp = ros::Time::now();
  grid.info.map_load_time = grid.header.stamp;

  ros::Publisher map_pub = nh.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  map_pub.publish(grid);
  ros::Publisher places_pub = nh.advertise<visualization_msgs::MarkerArray>("places", 1, true);
  places_pub.publish(markers_of(places, grid.header));
  using Request = nav_msgs::GetMap::Request;
  using Response = nav_msgs::GetMap::Response;
  ros::ServiceServer service = nh.advertiseService<Request, Response>(
      "static_map", [&grid](Request& /*request*/, Response& response) {
        response.map = grid;
        return true;
      });

  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID("none");
  diagnostics.add("map", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, params.own.map);
    status.add("width [cells]", grid.info.width);
    status.add("height [cells]", grid.info.height);
    status.add("resolution [m]", grid.info.resolution);
  });
  const ros::Timer timer =
      nh.createTimer(ros::Duration(1.0), [&](const ros::TimerEvent&) { diagnostics.update(); });
  ROS_INFO_STREAM("serving " << params.own.map << ", " << grid.info.width << " x "
                             << grid.info.height << " cells");
  ros::spin();
  return 0;
}
