// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/model_folders.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <tinyxml2.h>

namespace cmn {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostIncludes = 20'000;
constexpr std::uintmax_t kLargestFile = 64U << 20U;  // [bytes]

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::string without(const std::string& prefix, const std::string& text) {
  return text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : "";
}

/// The texts of `name` elements anywhere below `element`.
void collect(const tinyxml2::XMLElement& element, const char* parent, const char* name,
             std::vector<std::string>& texts) {
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::string{element.Name()} == parent && std::string{child->Name()} == name &&
        child->GetText() != nullptr) {
      texts.emplace_back(child->GetText());
    }
    collect(*child, parent, name, texts);
  }
}

std::vector<std::string> texts_in(const fs::path& file, const char* parent, const char* name) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (!error && size > kLargestFile) {
    throw std::runtime_error(file.string() + ": larger than the 64 MB that such a file may have");
  }
  tinyxml2::XMLDocument document;
  std::vector<std::string> texts;
  if (document.LoadFile(file.c_str()) == tinyxml2::XML_SUCCESS &&
      document.RootElement() != nullptr) {
    collect(*document.RootElement(), parent, name, texts);
  }
  return texts;
}

/// The SDF files that stand for a model's folder, or the file itself.
std::vector<fs::path> files_of(const fs::path& model) {
  if (!is_folder(model)) {
    return {model};
  }
  std::vector<fs::path> files;
  for (const std::string& name : texts_in(model / "model.config", "model", "sdf")) {
    files.push_back(model / name);
  }
  if (files.empty()) {
    files.push_back(model / "model.sdf");
  }
  return files;
}

class IncludeCounter {
 public:
  explicit IncludeCounter(const std::vector<std::string>& folders) : folders_{folders} {}

  std::size_t count(const fs::path& file) {
    const std::string key = file.lexically_normal().string();
    const auto [at, is_new] = counts_.emplace(key, 0);
    if (!is_new) {
      if (at->second == 0) {
        throw std::runtime_error(key + ": includes itself");
      }
      return at->second;
    }
    if (++depth_ > 100) {
      throw std::runtime_error(key + ": lies more than 100 includes deep");
    }
    std::size_t sum = 1;
    for (const std::string& uri : texts_in(file, "include", "uri")) {
      const std::string model = find_uri(uri, file.parent_path().string(), folders_);
      if (model.empty()) {
        missing_.push_back(uri);
        continue;
      }
      for (const fs::path& included : files_of(model)) {
        sum += count(included);
        if (sum > kMostIncludes) {
          throw std::runtime_error(key + ": includes more than " + std::to_string(kMostIncludes) +
                                   " files");
        }
      }
    }
    --depth_;
    return counts_[key] = sum;
  }
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  const std::vector<std::string>& folders_;
  std::map<std::string, std::size_t> counts_;  ///< 0: under way
  std::vector<std::string> missing_;
  int depth_ = 0;
};

}  // namespace

std::vector<std::string> model_folders(const std::string& world) {
  std::error_code error;
  const fs::path own = fs::absolute(world, error).parent_path();
  std::vector<fs::path> folders{own, own / "models", own.parent_path(),
                                own.parent_path() / "models"};
  if (const char* paths = std::getenv("GAZEBO_MODEL_PATH")) {
    std::istringstream list{paths};
    for (std::string path; std::getline(list, path, ':');) {
      folders.emplace_back(path);
    }
  }
  if (const char* data = std::getenv("CMN_DATA_DIR")) {
    std::vector<fs::path> in_data;
    for (const auto& entry : fs::directory_iterator(data, error)) {
      in_data.push_back(entry.path() / "models");
    }
    std::sort(in_data.begin(), in_data.end());
    folders.insert(folders.end(), in_data.begin(), in_data.end());
  }
  std::vector<std::string> present;
  for (const fs::path& folder : folders) {
    if (!folder.empty() && is_folder(folder)) {
      present.push_back(folder.string());
    }
  }
  return present;
}

std::string find_uri(const std::string& uri, const std::string& folder,
                     const std::vector<std::string>& folders) {
  if (const std::string model = without("model://", uri); !model.empty()) {
    for (const std::string& place : folders) {
      if (is_there(fs::path{place} / model)) {
        return (fs::path{place} / model).string();
      }
    }
    return "";
  }
  const std::string path = without("file://", uri);
  const fs::path found = fs::path{folder} / (path.empty() ? uri : path);
  return !uri.empty() && is_there(found) ? found.string() : "";
}

std::vector<std::string> check_includes(const std::string& world,
                                        const std::vector<std::string>& folders) {
  IncludeCounter counter{folders};
  counter.count(world);
  return counter.missing();
}

}  // namespace cmn
