// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Configuration: one list of parameters that loading, validation, YAML and documentation all walk.
///
/// A component declares its parameters as a struct with defaults that can be walked:
///
///     struct GuardParams {
///       double occupied_share = 0.25;
///       template <class Self, class Visitor>
///       static void visit_params(Self& self, Visitor&& visit) {
///         visit("occupied_share", self.occupied_share, Between{0.0, 1.0}, "[-] ...");
///       }
///     };
///
/// `Self` is const for documentation and mutable for loading. A struct of such structs walks them
/// with `visit.group("name", self.member)`.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace cmn {

/// lowest <= value <= highest.
struct Between {
  double lowest;
  double highest;
};
/// A multiple of `of`, from `of` to `highest`.
struct MultipleOf {
  int of;
  int highest;
};
/// One of these words.
struct OneOf {
  std::vector<std::string> words;
};
/// Any value of the type.
struct Anything {};

using ParamValue = std::variant<bool, double, std::string>;
/// Configuration as read from a file or a parameter server: "group/name" -> value.
using ParamTree = std::map<std::string, ParamValue>;

/// Walks a parameter struct, taking values from a tree; collects every problem.
class ParamLoader {
 public:
  explicit ParamLoader(const ParamTree& tree) : tree_{tree} {}

  template <class Group>
  void group(const std::string& name, Group& params) {
    const std::string outer = prefix_;
    prefix_ += name + "/";
    Group::visit_params(params, *this);
    prefix_ = outer;
  }
  void operator()(const std::string& name, double& value, Between range, const char* doc);
  void operator()(const std::string& name, int& value, Between range, const char* doc);
  void operator()(const std::string& name, int& value, MultipleOf range, const char* doc);
  void operator()(const std::string& name, std::uint32_t& value, Between range, const char* doc);
  void operator()(const std::string& name, bool& value, Anything any, const char* doc);
  void operator()(const std::string& name, std::string& value, const OneOf& words, const char* doc);
  void operator()(const std::string& name, std::string& value, Anything any, const char* doc);

  /// Everything wrong so far, keys of the tree that nobody asked for included.
  std::vector<std::string> problems() const;

 private:
  bool find_number(const std::string& name, Between range, bool integer, double& value);
  bool find_word(const std::string& name, std::string& value);

  const ParamTree& tree_;
  std::string prefix_;
  std::set<std::string> known_;
  std::vector<std::string> problems_;
};

/// Fills `params` from `tree`. Returns every problem, worded for the user; empty when all is well.
template <class Params>
std::vector<std::string> load_params(const ParamTree& tree, Params& params) {
  ParamLoader loader{tree};
  Params::visit_params(params, loader);
  return loader.problems();
}

/// One line of the documentation.
struct ParamDoc {
  std::string path;           ///< "group/name"
  std::string default_value;  ///< as it stands in YAML
  std::string range;
  std::string text;
};
/// Walks a parameter struct and writes down what it holds.
class ParamLister {
 public:
  template <class Group>
  void group(const std::string& name, const Group& params) {
    const std::string outer = prefix_;
    prefix_ += name + "/";
    Group::visit_params(params, *this);
    prefix_ = outer;
  }
  void operator()(const std::string& name, double value, Between range, const char* doc);
  void operator()(const std::string& name, int value, Between range, const char* doc);
  void operator()(const std::string& name, int value, MultipleOf range, const char* doc);
  void operator()(const std::string& name, std::uint32_t value, Between range, const char* doc);
  void operator()(const std::string& name, bool value, Anything any, const char* doc);
  void operator()(const std::string& name, const std::string& value, const OneOf& words,
                  const char* doc);
  void operator()(const std::string& name, const std::string& value, Anything any, const char* doc);

  const std::vector<ParamDoc>& docs() const { return docs_; }

 private:
  std::string prefix_;
  std::vector<ParamDoc> docs_;
};

template <class Params>
std::vector<ParamDoc> list_params(const Params& params) {
  ParamLister lister;
  Params::visit_params(params, lister);
  return lister.docs();
}

/// Reads a YAML file of nested maps and scalars. Throws std::runtime_error, naming file and line.
ParamTree read_param_file(const std::string& path);

}  // namespace cmn
