// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a tool needs of its command line: options that must be there, files of parameters.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"

#include <stdexcept>
#include <string>

#include <boost/program_options.hpp>

namespace cmn {

/// The value of an option without a default. Throws std::runtime_error naming it where it is
/// absent.
inline std::string needed(const boost::program_options::variables_map& given, const char* option) {
  if (given.count(option) == 0) {
    throw std::runtime_error(std::string{"--"} + option + " is needed; --help explains");
  }
  return given[option].as<std::string>();
}

/// What the file of `--params` makes of the defaults, or those where it is not given. Throws
/// std::runtime_error with all problems of the file.
template <class Params>
Params params_of(const boost::program_options::variables_map& given) {
  Params params;
  if (given.count("params") == 0) {
    return params;
  }
  const std::string path = given["params"].as<std::string>();
  std::string report;
  for (const std::string& problem : load_params(read_param_file(path), params)) {
    report += (report.empty() ? "" : "\n  ") + problem;
  }
  if (!report.empty()) {
    throw std::runtime_error(path + ": " + report);
  }
  return params;
}

}  // namespace cmn
