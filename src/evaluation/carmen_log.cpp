// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/carmen_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <zlib.h>

namespace cmn {
namespace {

constexpr double kNominalPeriod_s = 0.1;  // a CARMEN base reports at about 10 Hz
constexpr double kSmallestPeriod_s = 1e-3;
constexpr double kMetresPerRadian = 0.5;  // weighs turning against driving

/// A FLASER or ODOM line.
struct Record {
  double stamp_s = 0.0;
  Pose2 pose;
  bool is_scan = false;
  std::vector<float> ranges_m;
};

/// The words of a line, one at a time; remembers whether a number was missing.
class Words {
 public:
  explicit Words(const std::string& line) : at_{line.c_str()} {}

  std::string word() {
    skip_blanks();
    const char* begin = at_;
    while (*at_ != '\0' && !is_blank(*at_)) {
      ++at_;
    }
    return {begin, at_};
  }
  double number() {
    skip_blanks();
    char* end = nullptr;
    const double value = std::strtod(at_, &end);
    if (end == at_ || (*end != '\0' && !is_blank(*end))) {
      failed_ = true;
      return std::numeric_limits<double>::quiet_NaN();
    }
    at_ = end;
    return value;
  }
  /// As number(), but a word that is none is passed over and gives NaN.
  double number_or_nan() {
    const std::string text = word();
    failed_ = failed_ || text.empty();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
  }
  bool failed() const { return failed_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (is_blank(*at_)) {
      ++at_;
    }
  }
  const char* at_;
  bool failed_ = false;
};

Pose2 pose_of(Words& words) {
  Pose2 pose;
  pose.x = words.number();
  pose.y = words.number();
  pose.yaw = wrap_angle(words.number());
  return pose;
}

bool is_finite(const Record& r) {
  return std::isfinite(r.pose.x) && std::isfinite(r.pose.y) && std::isfinite(r.pose.yaw) &&
         std::isfinite(r.stamp_s);
}

float range_of(double number) {
  if (number >= kCarmenMaxRange_m) {
    return std::numeric_limits<float>::infinity();
  }
  return number >= 0.0 ? static_cast<float>(number) : std::numeric_limits<float>::quiet_NaN();
}

/// A FLASER line behind its keyword; the reason when it is not one.
std::optional<std::string> parse_scan(Words& words, Record& record) {
  const double count = words.number();
  if (words.failed() || !(count >= 2 && count <= 100000) || count != std::floor(count)) {
    return "FLASER: the number of beams is missing or senseless";
  }
  record.is_scan = true;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    record.ranges_m.push_back(range_of(words.number_or_nan()));
  }
  record.pose = pose_of(words);
  pose_of(words);  // the odometry's; the same in a corrected log
  record.stamp_s = words.number();
  if (words.failed() || !is_finite(record)) {
    return "FLASER: ranges, pose or stamp missing, or not a number";
  }
  // The logger's host and stamp may follow; more means that the number of beams is wrong.
  words.word();
  words.word();
  if (!words.word().empty()) {
    return "FLASER: more values than the number of beams says";
  }
  return std::nullopt;
}

/// An ODOM line behind its keyword; the reason when it is not one.
std::optional<std::string> parse_odometry(Words& words, Record& record) {
  record.pose = pose_of(words);
  for (int i = 0; i < 3; ++i) {
    words.number();  // speeds and acceleration
  }
  record.stamp_s = words.number();
  if (words.failed() || !is_finite(record)) {
    return "ODOM: pose, speed or stamp missing, or not a number";
  }
  return std::nullopt;
}

/// GMapping writes each corrected pose once more as an ODOM line with a meaningless stamp.
bool repeats(const Record& odometry, const Record& before) {
  return before.is_scan && odometry.stamp_s < before.stamp_s && odometry.pose.x == before.pose.x &&
         odometry.pose.y == before.pose.y && odometry.pose.yaw == before.pose.yaw;
}

/// A scan and the odometry line it was taken with have one stamp.
bool is_pair(const Record& before, const Record& now) {
  return now.is_scan && !before.is_scan && now.stamp_s == before.stamp_s;
}

/// The longest strictly increasing subsequence, as indices (Schensted 1961; n log n).
std::vector<std::size_t> increasing_subsequence(const std::vector<double>& values) {
  std::vector<std::size_t> tails;  // tails[k]: the smallest end of a subsequence of k + 1 values
  std::vector<std::size_t> before(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto place =
        std::lower_bound(tails.begin(), tails.end(), values[i],
                         [&](std::size_t tail, double value) { return values[tail] < value; });
    before[i] = place == tails.begin() ? i : *(place - 1);
    if (place == tails.end()) {
      tails.push_back(i);
    } else {
      *place = i;
    }
  }
  std::vector<std::size_t> chosen(tails.size());
  for (std::size_t k = tails.size(), i = tails.empty() ? 0 : tails.back(); k > 0; i = before[i]) {
    chosen[--k] = i;
  }
  return chosen;
}

/// Keeps as many stamps as can be in order and spreads the others evenly between those.
void order_stamps(std::vector<double>& stamps, CarmenLog& log) {
  const auto [earliest, latest] = std::minmax_element(stamps.begin(), stamps.end());
  log.has_clock = stamps.size() == 1 ||
                  *latest - *earliest >= kSmallestPeriod_s * static_cast<double>(stamps.size());
  const std::vector<std::size_t> kept =
      log.has_clock ? increasing_subsequence(stamps) : std::vector<std::size_t>{0};
  log.moved_stamps = log.has_clock ? stamps.size() - kept.size() : 0;
  for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
    const double period =
        (stamps[kept[k + 1]] - stamps[kept[k]]) / static_cast<double>(kept[k + 1] - kept[k]);
    for (std::size_t i = kept[k] + 1; i < kept[k + 1]; ++i) {
      stamps[i] = stamps[i - 1] + period;
    }
  }
  for (std::size_t i = kept.front(); i > 0; --i) {
    stamps[i - 1] = stamps[i] - kNominalPeriod_s;
  }
  for (std::size_t i = kept.back() + 1; i < stamps.size(); ++i) {
    stamps[i] = stamps[i - 1] + kNominalPeriod_s;
  }
}

void order_stamps(std::vector<Record>& records, CarmenLog& log) {
  std::vector<double> stamps;
  std::vector<std::size_t> moment(records.size());  // of each record, an index into stamps
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i == 0 || !is_pair(records[i - 1], records[i])) {
      stamps.push_back(records[i].stamp_s);
    }
    moment[i] = stamps.size() - 1;
  }
  order_stamps(stamps, log);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].stamp_s = stamps[moment[i]];
  }
}

double motion_between(const Pose2& a, const Pose2& b) {
  return norm(b.position() - a.position()) + kMetresPerRadian * std::abs(wrap_angle(b.yaw - a.yaw));
}

/// Appends odometry poses [begin, end), bent so that they run into the corrected pose of the scan
/// at `end`.
void append_stretch(const std::vector<Record>& records, std::size_t begin, std::size_t end,
                    CarmenLog& log) {
  const Pose2 residual = inverse(records[end - 1].pose) * records[end].pose;
  std::vector<double> motion{0.0};
  for (std::size_t i = begin; i < end; ++i) {
    const double step = i == 0 ? 0.0 : motion_between(records[i - 1].pose, records[i].pose);
    motion.push_back(motion.back() + step);
  }
  for (std::size_t i = begin; i < end; ++i) {
    if (records[i].stamp_s >= records[end].stamp_s) {
      break;  // the scan itself stands for it
    }
    const double share = motion.back() > 0.0 ? motion[i - begin + 1] / motion.back() : 0.0;
    const Pose2 bend{share * residual.x, share * residual.y, share * residual.yaw};
    log.poses.push_back({records[i].stamp_s, records[i].pose * bend});
  }
}

void join_path(std::vector<Record>& records, CarmenLog& log) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!records[i].is_scan) {
      continue;
    }
    if (i > begin) {
      append_stretch(records, begin, i, log);
    }
    log.scans.push_back({log.poses.size(), std::move(records[i].ranges_m)});
    log.poses.push_back({records[i].stamp_s, records[i].pose});
    begin = i + 1;
  }
  for (std::size_t i = begin; i < records.size(); ++i) {
    log.poses.push_back({records[i].stamp_s, records[i].pose});
  }
}

}  // namespace

CarmenLog parse_carmen_log(const std::string& text) {
  CarmenLog log;
  std::vector<Record> records;
  std::istringstream lines{text};
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    Words words{line};
    const std::string kind = words.word();
    if (kind == "PARAM") {
      const std::string name = words.word();
      log.params[name] = words.word();
      continue;
    }
    if (kind != "FLASER" && kind != "ODOM") {
      log.other_lines += kind.empty() ? 0 : 1;
      continue;
    }
    Record record;
    const auto problem =
        kind == "FLASER" ? parse_scan(words, record) : parse_odometry(words, record);
    if (problem) {
      log.malformed.push_back({number, *problem});
    } else if (!record.is_scan && !records.empty() && repeats(record, records.back())) {
      ++log.repeated_poses;
    } else {
      records.push_back(std::move(record));
    }
  }
  if (!records.empty()) {
    order_stamps(records, log);
    join_path(records, log);
  }
  if (log.scans.empty()) {
    std::string reason = "no usable FLASER line: is this a CARMEN log?";
    if (!log.malformed.empty()) {
      reason +=
          " Line " + std::to_string(log.malformed.front().line) + ": " + log.malformed.front().text;
    }
    throw std::runtime_error(reason);
  }
  return log;
}

CarmenLog read_carmen_log(const std::string& path) {
  // zlib reads a file that is not compressed as it stands.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file{gzopen(path.c_str(), "rb"), &gzclose_r};
  if (!file) {
    throw std::runtime_error(path + ": cannot be opened");
  }
  std::string text;
  std::vector<char> block(1 << 16);
  int got = 0;
  while ((got = gzread(file.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    text.append(block.data(), static_cast<std::size_t>(got));
  }
  int error = Z_OK;
  gzerror(file.get(), &error);
  if (got < 0 || (error != Z_OK && error != Z_STREAM_END)) {
    throw std::runtime_error(path + ": is damaged or not a file (after " +
                             std::to_string(text.size()) + " bytes)");
  }
  try {
    return parse_carmen_log(text);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

}  // namespace cmn
