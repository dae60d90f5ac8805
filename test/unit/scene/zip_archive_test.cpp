// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/zip_archive.hpp"

#include <string>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

/// A number of `bytes` bytes, the lowest first, as zip files have them.
std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) {
    text += static_cast<char>(value >> (8 * i));
  }
  return text;
}

/// An archive of one file that is not compressed (APPNOTE.TXT 4.3). `size`: what it says of it.
std::string archive_of(const std::string& name, const std::string& content, std::uint32_t size) {
  const auto crc = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
  const std::string about = little(20, 2) + little(0, 2) + little(0, 2) + little(0, 2) +
                            little(33, 2) + little(crc, 4) + little(size, 4) + little(size, 4) +
                            little(static_cast<std::uint32_t>(name.size()), 2) + little(0, 2);
  const std::string local = "PK\3\4" + about + name + content;
  const std::string central =
      "PK\1\2" + little(20, 2) + about + little(0, 6) + little(0, 4) + little(0, 4) + name;
  return local + central + "PK\5\6" + little(0, 4) + little(1, 2) + little(1, 2) +
         little(static_cast<std::uint32_t>(central.size()), 4) +
         little(static_cast<std::uint32_t>(local.size()), 4) + little(0, 2);
}

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(ZipArchive, HandsOutItsFiles) {
  const std::string path = file_with("a.zip", archive_of("chair/leg.obj", "v 1 2 3", 7));
  const ZipArchive archive{path};
  EXPECT_EQ(archive.path(), path);
  EXPECT_TRUE(archive.contains("chair/leg.obj"));
  EXPECT_EQ(text_of(archive.read("chair/leg.obj")), "v 1 2 3");
}

TEST(ZipArchive, OfAFileThatIsNotInItThereIsNothing) {
  const ZipArchive archive{file_with("a.zip", archive_of("a", "b", 1))};
  EXPECT_FALSE(archive.contains("b"));
  EXPECT_TRUE(archive.read("b").empty());
  EXPECT_TRUE(archive.read("").empty());
}

TEST(ZipArchive, BrokenAndEnormousFilesAreEmpty) {
  std::string spoilt = archive_of("a", "abcdef", 6);
  spoilt[spoilt.find("abcdef") + 2] = 'x';
  EXPECT_TRUE((ZipArchive{file_with("spoilt.zip", spoilt)}.read("a").empty())) << "its sum is off";
  const std::string huge = file_with("huge.zip", archive_of("a", "abcdef", 0x7fffffffU));
  std::string why;
  try {
    EXPECT_TRUE((ZipArchive{huge}.read("a").empty()));
  } catch (const std::runtime_error& e) {  // it may already be seen to be none
    why = e.what();
  }
  EXPECT_THAT(why, testing::AnyOf("", HasSubstr(huge)));
}

TEST(ZipArchive, WhatIsNoArchiveIsAnErrorThatNamesIt) {
  EXPECT_THAT(error_of([] { ZipArchive{"/nowhere/a.zip"}; }), HasSubstr("/nowhere/a.zip: "));
  const std::string text = file_with("text.zip", "this is no zip archive");
  EXPECT_THAT(error_of([&] { ZipArchive{text}; }), HasSubstr(text + ": "));
  const std::string cut = file_with("cut.zip", archive_of("a", "abc", 3).substr(0, 40));
  EXPECT_THAT(error_of([&] { ZipArchive{cut}; }), HasSubstr(cut + ": "));
}

}  // namespace
}  // namespace cmn
