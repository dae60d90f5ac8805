// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nodes that a test starts and kills as it likes, topics that it watches, waits with a deadline.
#pragma once

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <fcntl.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cmn {

/// Nothing takes so long [s] unless it never happens: the machine may be busy.
constexpr double kPatience_s = 30.0;

/// Handles messages until `holds()` is true, which is returned, or the patience is at its end.
template <class Predicate>
bool wait_for(Predicate&& holds, double patience_s = kPatience_s) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience_s);
  while (!holds()) {
    if (!ros::ok() || ros::WallTime::now() > end) {
      return false;
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.005));
  }
  return true;
}

/// All messages of a topic since it was made or cleared.
template <class Message>
class Inbox {
 public:
  explicit Inbox(const std::string& topic)
      : subscriber_{ros::NodeHandle().subscribe<Message>(
            topic, 1000, [this](const auto& message) { all_.push_back(message); })} {}

  bool empty() const { return all_.empty(); }
  std::size_t size() const { return all_.size(); }
  const Message& back() const { return *all_.back(); }
  const std::vector<typename Message::ConstPtr>& all() const { return all_; }
  void clear() { all_.clear(); }
  bool is_connected() const { return subscriber_.getNumPublishers() > 0; }

 private:
  std::vector<typename Message::ConstPtr> all_;
  ros::Subscriber subscriber_;
};

/// A program of this package in a process of its own, ended with it.
class NodeProcess {
 public:
  explicit NodeProcess(const std::string& program, std::vector<std::string> arguments = {}) {
    // Nodes and tests lie in one folder.
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    arguments.insert(arguments.begin(), (folder / program).string());
    std::vector<char*> argv;
    for (std::string& argument : arguments) {
      argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    char log[] = "/tmp/cmn_rostest_XXXXXX";
    const int output = mkstemp(log);
    log_ = log;
    pid_ = fork();
    if (pid_ == 0) {
      signal(SIGINT, SIG_DFL);  // a background job of a shell ignores it
      dup2(output, STDOUT_FILENO);
      dup2(output, STDERR_FILENO);
      execv(argv.front(), argv.data());
      _exit(127);
    }
    close(output);
  }
  ~NodeProcess() {
    end(SIGINT);
    std::filesystem::remove(log_);
  }
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  /// The exit status, once it has ended by itself; 128 + signal when a signal ended it.
  std::optional<int> exit_status() {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) {
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return status_;
  }
  bool is_running() { return !exit_status(); }
  /// Asks it to end with `signal`, after a while with SIGKILL, and waits until it has.
  void end(int signal) {
    const auto has_ended = [this] { return exit_status().has_value(); };
    if (!has_ended()) {
      kill(pid_, signal);
      const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(10.0);
      while (!has_ended()) {
        if (ros::WallTime::now() > deadline) {
          kill(pid_, SIGKILL);
        }
        ros::WallDuration(0.005).sleep();
      }
    }
  }
  /// What it has printed and logged so far.
  std::string output() const {
    std::ostringstream text;
    text << std::ifstream{log_}.rdbuf();
    return text.str();
  }

 private:
  std::string log_;
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// The number under a key of the status whose name ends in `name`, if the message has it.
inline std::optional<double> diagnosed(const diagnostic_msgs::DiagnosticArray& message,
                                       const std::string& name, const std::string& key) {
  for (const auto& status : message.status) {
    const bool is_it = status.name.size() >= name.size() &&
                       status.name.substr(status.name.size() - name.size()) == name;
    for (const auto& entry : status.values) {
      if (is_it && entry.key == key) {
        return std::strtod(entry.value.c_str(), nullptr);
      }
    }
  }
  return std::nullopt;
}

/// The newest such number; 0 while there is none.
inline double diagnosed(const Inbox<diagnostic_msgs::DiagnosticArray>& diagnostics,
                        const std::string& name, const std::string& key) {
  double value = 0.0;
  for (const auto& message : diagnostics.all()) {
    value = diagnosed(*message, name, key).value_or(value);
  }
  return value;
}

}  // namespace cmn
