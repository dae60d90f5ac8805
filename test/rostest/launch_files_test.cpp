// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

std::vector<fs::path> launch_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(CMN_SOURCE_DIR "/launch")) {
    if (entry.path().extension() == ".launch") {
      files.push_back(entry.path());
    }
  }
  return files;
}

/// ` name:=x` for every argument that has no value and no default.
std::string required_arguments(const std::string& text) {
  std::string arguments;
  const std::regex top_level_argument{"<arg\\s[^>]*>"};
  const std::regex name{"name=\"([a-z_0-9]+)\""};
  for (std::sregex_iterator it{text.begin(), text.end(), top_level_argument}, end; it != end;
       ++it) {
    const std::string tag = it->str();
    std::smatch match;
    if (tag.find("default=") == std::string::npos && tag.find("value=") == std::string::npos &&
        std::regex_search(tag, match, name)) {
      arguments += " " + match[1].str() + ":=x";
    }
  }
  return arguments;
}

/// What `roslaunch ARGUMENTS` prints; it has to end well.
std::string roslaunch(const std::string& arguments) {
  const std::string command = "roslaunch " + arguments + " 2>&1";
  SCOPED_TRACE(command);
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  char line[512];
  while (pipe != nullptr && std::fgets(line, sizeof line, pipe) != nullptr) {
    output += line;
  }
  const int status = pipe != nullptr ? pclose(pipe) : -1;
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << output;
  EXPECT_EQ(output.find("RLException"), std::string::npos) << output;
  return output;
}

TEST(LaunchFiles, AllAreReadWithEveryFileThatTheyLoad) {
  ASSERT_GE(launch_files().size(), 3U);
  for (const fs::path& file : launch_files()) {
    roslaunch("--nodes '" + file.string() + "'" + required_arguments(text_of(file)));
  }
}

TEST(LaunchFiles, RobotsAreDescribedWhenAskedFor) {
  const std::string file = CMN_SOURCE_DIR "/launch/navigate.launch map:=x robot:=";
  for (const auto& entry : fs::directory_iterator(CMN_SOURCE_DIR "/urdf")) {
    const std::string robot = entry.path().stem();
    SCOPED_TRACE(robot);
    const std::string publisher =
        robot == "locobot" ? "/locobot/robot_state_publisher" : "/robot_state_publisher";
    EXPECT_EQ(roslaunch("--nodes " + file + robot).find(publisher), std::string::npos);
    const std::string asked = file + robot + " publish_robot:=true";
    EXPECT_NE(roslaunch("--nodes " + asked).find(publisher), std::string::npos);
    const std::string prefix = robot == "locobot" ? "locobot/" : "";
    const std::string parameters = roslaunch("--dump-params " + asked);
    EXPECT_NE(parameters.find(R"(\")" + prefix + R"(laser\")"), std::string::npos) << parameters;
  }
}

TEST(LaunchFiles, NameOnlyProgramsOfThePackageThatExist) {
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  const std::regex node{"pkg=\"coarse_map_nav\"\\s+type=\"([a-z_0-9]+)\""};
  for (const fs::path& file : launch_files()) {
    SCOPED_TRACE(file.string());
    const std::string text = text_of(file);
    for (std::sregex_iterator it{text.begin(), text.end(), node}, end; it != end; ++it) {
      const std::string type = (*it)[1].str();
      EXPECT_TRUE(fs::exists(programs / type) ||
                  fs::exists(fs::path{CMN_SOURCE_DIR "/src/tools"} / (type + ".cpp")) ||
                  fs::exists(fs::path{CMN_SOURCE_DIR "/scripts"} / type))
          << type;
    }
  }
}

}  // namespace
