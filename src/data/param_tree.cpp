// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/param_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

namespace cmn {
namespace {

/// As few digits as give the same number when read again.
std::string text_of(double value) {
  for (int digits = 6;; ++digits) {
    std::ostringstream out;
    out << std::setprecision(digits) << value;
    if (digits == std::numeric_limits<double>::max_digits10 ||
        std::strtod(out.str().c_str(), nullptr) == value) {
      return out.str();
    }
  }
}

std::string text_of(Between range) {
  return "[" + text_of(range.lowest) + ", " + text_of(range.highest) + "]";
}

std::string text_of(MultipleOf range) {
  return "multiples of " + std::to_string(range.of) + " up to " + std::to_string(range.highest);
}

std::string text_of(const OneOf& one_of) {
  std::string text;
  for (const std::string& word : one_of.words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

/// Levenshtein's edit distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::string nearest_of(const std::string& name, const std::set<std::string>& known) {
  const auto nearest =
      std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
        return edit_distance(name, a) < edit_distance(name, b);
      });
  return nearest == known.end() || edit_distance(name, *nearest) > name.size() / 2 ? "" : *nearest;
}

ParamValue scalar_of(const YAML::Node& node) {
  bool truth = false;
  double number = 0.0;
  if (node.Tag() != "!" && YAML::convert<bool>::decode(node, truth)) {
    return truth;
  }
  if (node.Tag() != "!" && YAML::convert<double>::decode(node, number)) {
    return number;
  }
  return node.Scalar();
}

void flatten(const YAML::Node& node, const std::string& prefix, const std::string& path,
             ParamTree& tree) {
  for (const auto& entry : node) {
    const std::string name = prefix + entry.first.Scalar();
    if (entry.second.IsMap()) {
      flatten(entry.second, name + "/", path, tree);
    } else if (entry.second.IsScalar()) {
      tree[name] = scalar_of(entry.second);
    } else {
      throw std::runtime_error(path + ":" + std::to_string(entry.second.Mark().line + 1) + ": " +
                               name + " is neither a value nor a group of values");
    }
  }
}

}  // namespace

bool ParamLoader::find_number(const std::string& name, Between range, bool integer, double& value) {
  const std::string path = prefix_ + name;
  known_.insert(path);
  const auto found = tree_.find(path);
  if (found == tree_.end()) {
    return false;
  }
  const double* number = std::get_if<double>(&found->second);
  if (number == nullptr) {
    problems_.push_back(path + ": expected a number");
    return false;
  }
  // Written this way round, the comparison also turns NaN away.
  if (!(*number >= range.lowest && *number <= range.highest)) {
    problems_.push_back(path + ": " + text_of(*number) + " is outside " + text_of(range));
    return false;
  }
  if (integer && *number != std::floor(*number)) {
    problems_.push_back(path + ": " + text_of(*number) + " is not a whole number");
    return false;
  }
  value = *number;
  return true;
}

bool ParamLoader::find_word(const std::string& name, std::string& value) {
  const std::string path = prefix_ + name;
  known_.insert(path);
  const auto found = tree_.find(path);
  if (found == tree_.end()) {
    return false;
  }
  const std::string* word = std::get_if<std::string>(&found->second);
  if (word == nullptr) {
    problems_.push_back(path + ": expected a word");
    return false;
  }
  value = *word;
  return true;
}

void ParamLoader::operator()(const std::string& name, double& value, Between range,
                             const char* /*doc*/) {
  find_number(name, range, false, value);
}

void ParamLoader::operator()(const std::string& name, int& value, Between range,
                             const char* /*doc*/) {
  double number = 0.0;
  if (find_number(name, range, true, number)) {
    value = static_cast<int>(number);
  }
}

void ParamLoader::operator()(const std::string& name, int& value, MultipleOf range,
                             const char* /*doc*/) {
  double number = 0.0;
  const Between bounds{static_cast<double>(range.of), static_cast<double>(range.highest)};
  if (!find_number(name, bounds, true, number)) {
    return;
  }
  if (static_cast<int>(number) % range.of != 0) {
    problems_.push_back(prefix_ + name + ": " + text_of(number) + " is none of the " +
                        text_of(range));
    return;
  }
  value = static_cast<int>(number);
}

void ParamLoader::operator()(const std::string& name, std::uint32_t& value, Between range,
                             const char* /*doc*/) {
  double number = 0.0;
  if (find_number(name, range, true, number)) {
    value = static_cast<std::uint32_t>(number);
  }
}

void ParamLoader::operator()(const std::string& name, bool& value, Anything /*any*/,
                             const char* /*doc*/) {
  const std::string path = prefix_ + name;
  known_.insert(path);
  const auto found = tree_.find(path);
  if (found == tree_.end()) {
    return;
  }
  if (const bool* truth = std::get_if<bool>(&found->second)) {
    value = *truth;
  } else {
    problems_.push_back(path + ": expected true or false");
  }
}

void ParamLoader::operator()(const std::string& name, std::string& value, const OneOf& words,
                             const char* /*doc*/) {
  std::string word;
  if (!find_word(name, word)) {
    return;
  }
  if (std::find(words.words.begin(), words.words.end(), word) == words.words.end()) {
    problems_.push_back(prefix_ + name + ": \"" + word + "\" is none of " + text_of(words));
    return;
  }
  value = word;
}

void ParamLoader::operator()(const std::string& name, std::string& value, Anything /*any*/,
                             const char* /*doc*/) {
  find_word(name, value);
}

std::vector<std::string> ParamLoader::problems() const {
  std::vector<std::string> all = problems_;
  for (const auto& entry : tree_) {
    if (known_.count(entry.first) == 0) {
      const std::string nearest = nearest_of(entry.first, known_);
      all.push_back(entry.first + ": unknown parameter" +
                    (nearest.empty() ? "" : ", did you mean " + nearest + "?"));
    }
  }
  return all;
}

void ParamLister::operator()(const std::string& name, double value, Between range,
                             const char* doc) {
  docs_.push_back({prefix_ + name, text_of(value), text_of(range), doc});
}

void ParamLister::operator()(const std::string& name, int value, Between range, const char* doc) {
  docs_.push_back({prefix_ + name, std::to_string(value), text_of(range), doc});
}

void ParamLister::operator()(const std::string& name, int value, MultipleOf range,
                             const char* doc) {
  docs_.push_back({prefix_ + name, std::to_string(value), text_of(range), doc});
}

void ParamLister::operator()(const std::string& name, std::uint32_t value, Between range,
                             const char* doc) {
  docs_.push_back({prefix_ + name, std::to_string(value), text_of(range), doc});
}

void ParamLister::operator()(const std::string& name, bool value, Anything /*any*/,
                             const char* doc) {
  docs_.push_back({prefix_ + name, value ? "true" : "false", "true, false", doc});
}

void ParamLister::operator()(const std::string& name, const std::string& value, const OneOf& words,
                             const char* doc) {
  docs_.push_back({prefix_ + name, value, text_of(words), doc});
}

void ParamLister::operator()(const std::string& name, const std::string& value, Anything /*any*/,
                             const char* doc) {
  docs_.push_back({prefix_ + name, "\"" + value + "\"", "any text", doc});
}

ParamTree read_param_file(const std::string& path) {
  ParamTree tree;
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (root.IsMap()) {
      flatten(root, "", path, tree);
    } else if (!root.IsNull()) {
      throw std::runtime_error(path + ": the top level is not a map of parameters");
    }
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
  return tree;
}

}  // namespace cmn
