// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_localization_error: how far `belief` is from `ground_truth`, of a recorded bag or live.

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/evaluation/error_plot.hpp"
#include "coarse_map_nav/evaluation/localization_error.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/ros/conversions.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <opencv2/imgcodecs.hpp>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_ros/static_transform_broadcaster.h>

namespace {

namespace po = boost::program_options;
constexpr std::size_t kTableRows = 30;

/// What was heard on the two topics.
struct Recording {
  std::vector<cmn::BeliefSample> beliefs;
  cmn::TruthTrack truth;
  std::string truth_frame;
  std::size_t senseless = 0;  ///< messages without a proper pose

  void add(const coarse_map_nav::Belief& message) {
    if (const auto pose = cmn::pose_of(message.estimate)) {
      beliefs.push_back({message.header.stamp.toSec(), *pose, message.confidence, message.entropy,
                         message.converged != 0});
    } else {
      ++senseless;
    }
  }
  void add(const nav_msgs::Odometry& message) {
    truth_frame = message.header.frame_id;
    if (const auto pose = cmn::pose_of(message.pose.pose)) {
      truth.add(message.header.stamp.toSec(), *pose);
    } else {
      ++senseless;
    }
  }
};

/// Topics in a bag may stand with or without a leading slash or namespace.
bool ends_with(const std::string& topic, const std::string& name) {
  return topic == name ||
         (topic.size() > name.size() &&
          topic.compare(topic.size() - name.size() - 1, std::string::npos, "/" + name) == 0);
}

Recording read_bag(const std::string& path) {
  Recording recording;
  rosbag::Bag bag{path, rosbag::bagmode::Read};
  rosbag::View view{bag, [](const rosbag::ConnectionInfo* connection) {
                      return ends_with(connection->topic, "belief") ||
                             ends_with(connection->topic, "ground_truth");
                    }};
  for (const rosbag::MessageInstance& message : view) {
    if (const auto belief = message.instantiate<coarse_map_nav::Belief>()) {
      recording.add(*belief);
    } else if (const auto truth = message.instantiate<nav_msgs::Odometry>()) {
      recording.add(*truth);
    }
  }
  return recording;
}

/// Listens until the node is told to end. The map is taken to lie where the world lies: the two
/// frames become one, so that rviz shows the truth on the map.
Recording listen() {
  Recording recording;
  ros::NodeHandle nh;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  const auto belief_sub = nh.subscribe<coarse_map_nav::Belief>(
      "belief", 1000, [&](const coarse_map_nav::BeliefConstPtr& m) { recording.add(*m); });
  const auto truth_sub = nh.subscribe<nav_msgs::Odometry>(
      "ground_truth", 10000, [&](const nav_msgs::OdometryConstPtr& m) {
        if (recording.truth_frame.empty()) {
          geometry_msgs::TransformStamped same;
          same.header = m->header;
          same.header.frame_id = "map";
          same.child_frame_id = m->header.frame_id;
          same.transform.rotation.w = 1.0;
          broadcaster.sendTransform(same);
        }
        recording.add(*m);
      });
  ros::spin();
  return recording;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file{path};
  file << text;
  if (!file.flush()) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

void write_picture(const std::filesystem::path& path, const cv::Mat& picture) {
  if (!cv::imwrite(path.string(), picture, {cv::IMWRITE_PNG_COMPRESSION, 9})) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

void write_results(const Recording& recording, const std::string& out, const std::string& title,
                   const std::optional<cmn::CoarseMap>& map) {
  const auto errors = cmn::errors_of(recording.beliefs, recording.truth);
  if (errors.empty()) {
    throw std::runtime_error("heard " + std::to_string(recording.beliefs.size()) +
                             " beliefs, but none at a moment whose ground_truth is known");
  }
  const std::string summary = cmn::text_of(cmn::summary_of(errors));
  std::cout << cmn::table_of(errors, kTableRows) << "\n" << summary;
  if (recording.senseless > 0) {
    std::cerr << recording.senseless << " messages without a proper pose left out\n";
  }
  const std::filesystem::path folder{out};
  std::filesystem::create_directories(folder);
  write_file(folder / "error.csv", cmn::csv_of(errors));
  write_file(folder / "summary.txt", summary);
  write_picture(folder / "error.png", cmn::error_plot(errors, title));
  if (map) {
    write_picture(folder / "track.png", cmn::track_plot(errors, *map));
  }
  std::cout << "written: " << out << "/error.csv, summary.txt, error.png"
            << (map ? ", track.png" : "") << std::endl;
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "localization_error");
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  words.erase(words.begin());

  po::options_description options{
      "cmn_localization_error [--bag RECORDED.bag] --out DIR [options]\n\n"
      "Compares belief (coarse_map_nav/Belief) with ground_truth (nav_msgs/Odometry), of a bag "
      "or,\n"
      "without --bag, live until it is told to end. Prints a table and a summary, writes "
      "error.csv,\n"
      "summary.txt and error.png. The map must lie where the world lies (cmn_coarsen keeps it "
      "so).\n"
      "Options"};
  options.add_options()("help", "print this")("bag", po::value<std::string>(), "the recorded bag")(
      "out", po::value<std::string>(), "folder for the results")(
      "map", po::value<std::string>(), "the coarse map: draws the path on it, track.png")(
      "title", po::value<std::string>()->default_value("localization error"), "of the plot");
  po::variables_map given;
  po::store(po::command_line_parser(words).options(options).run(), given);
  if (given.count("help") != 0 || words.empty()) {
    std::cout << options;
    return words.empty() ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  if (given.count("out") == 0) {
    throw std::runtime_error("--out DIR is needed; --help explains");
  }
  std::optional<cmn::CoarseMap> map;
  if (given.count("map") != 0) {
    map = cmn::read_map(given["map"].as<std::string>());
  }
  const Recording recording =
      given.count("bag") != 0 ? read_bag(given["bag"].as<std::string>()) : listen();
  write_results(recording, given["out"].as<std::string>(), given["title"].as<std::string>(), map);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
