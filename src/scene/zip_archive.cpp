// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/zip_archive.hpp"

#include <stdexcept>

#include <zip.h>

namespace cmn {
namespace {

constexpr zip_uint64_t kLargestFile = 256U << 20U;  // [bytes]

struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

}  // namespace

void ZipArchive::Close::operator()(zip* archive) const { zip_discard(archive); }

ZipArchive::ZipArchive(const std::string& path) : path_{path} {
  int code = 0;
  archive_.reset(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive_) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw std::runtime_error(path + ": " + reason);
  }
}

bool ZipArchive::contains(const std::string& file) const {
  return zip_name_locate(archive_.get(), file.c_str(), 0) >= 0;
}

std::vector<std::uint8_t> ZipArchive::read(const std::string& file) const {
  zip_stat_t about;
  zip_stat_init(&about);
  if (zip_stat(archive_.get(), file.c_str(), 0, &about) != 0 ||
      (about.valid & ZIP_STAT_SIZE) == 0 || about.size > kLargestFile) {
    return {};
  }
  const std::unique_ptr<zip_file_t, CloseFile> opened{zip_fopen(archive_.get(), file.c_str(), 0)};
  std::vector<std::uint8_t> bytes(about.size);
  std::uint8_t beyond = 0;  // only who asks for more is told that the sum is off
  if (!opened ||
      zip_fread(opened.get(), bytes.data(), bytes.size()) !=
          static_cast<zip_int64_t>(bytes.size()) ||
      zip_fread(opened.get(), &beyond, 1) != 0) {
    return {};
  }
  return bytes;
}

}  // namespace cmn
