// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/npy_reader.hpp"

#include "coarse_map_nav/mapping/map_reader.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

std::string npy(const std::string& header, const std::string& data, int version = 1) {
  std::string text = "\x93NUMPY";
  text += {static_cast<char>(version), '\0'};
  std::size_t length = header.size();
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i, length /= 256) {
    text += static_cast<char>(length % 256);
  }
  return text + header + data;
}

std::string header(const std::string& descr, const std::string& order = "False",
                   const std::string& shape = "(2, 3)") {
  return "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", } \n";
}

std::vector<double> values(const std::string& content) {
  return read_npy(file_with("array.npy", content)).values();
}

template <class T>
void expect_type_is_read(const std::string& descr) {
  SCOPED_TRACE(descr);
  EXPECT_THAT(values(npy(header(descr), bytes_of(std::vector<T>{0, 1, 0, 1, 1, 0}))),
              ElementsAre(1, 1, 0, 0, 1, 0));
}

TEST(NpyReader, ReadsEveryTypeWithTheFirstRowOnTop) {
  expect_type_is_read<double>("<f8");
  expect_type_is_read<float>("<f4");
  expect_type_is_read<std::int64_t>("<i8");
  expect_type_is_read<std::int32_t>("<i4");
  expect_type_is_read<std::int16_t>("<i2");
  expect_type_is_read<std::int8_t>("|i1");
  expect_type_is_read<std::uint64_t>("<u8");
  expect_type_is_read<std::uint32_t>("<u4");
  expect_type_is_read<std::uint16_t>("<u2");
  expect_type_is_read<std::uint8_t>("|u1");
  expect_type_is_read<std::uint8_t>("|b1");
}

TEST(NpyReader, ReadsFortranOrder) {
  const std::vector<std::uint8_t> data{0, 1, 2, 3, 4, 5};
  EXPECT_THAT(values(npy(header("|u1", "True"), bytes_of(data))), ElementsAre(1, 3, 5, 0, 2, 4));
}

TEST(NpyReader, ReadsAllVersions) {
  const std::string data = bytes_of(std::vector<std::uint8_t>{0, 1, 0, 1, 1, 0});
  for (const int version : {1, 2, 3}) {
    EXPECT_THAT(values(npy(header("|u1"), data, version)), ElementsAre(1, 1, 0, 0, 1, 0));
  }
}

TEST(NpyReader, ReadsAnyOrderOfKeysAndDoubleQuotes) {
  EXPECT_THAT(values(npy(R"({"shape":(1,2),"fortran_order":False,"descr":"|u1"})", "\1\2")),
              ElementsAre(1, 2));
}

TEST(NpyReader, RejectsMalformedFilesWithTheReason) {
  const std::string data(64, '\0');
  const auto problem = [](const std::string& content) {
    const std::string path = file_with("bad.npy", content);
    const std::string error = error_of([&] { read_npy(path); });
    EXPECT_THAT(error, HasSubstr(path));
    return error;
  };
  const auto problem_of_shape = [&](const std::string& shape) {
    return problem(npy(header("<f8", "False", shape), data));
  };
  EXPECT_THAT(problem(""), HasSubstr("mark"));
  EXPECT_THAT(problem("\x93NUMP"), HasSubstr("mark"));
  EXPECT_THAT(problem("this is no array"), HasSubstr("mark"));
  EXPECT_THAT(problem(npy(header("<f8"), data, 4)), HasSubstr("version is 4"));
  EXPECT_THAT(problem(npy(header("<f8"), "").substr(0, 30)), HasSubstr("ends within the header"));
  EXPECT_THAT(problem(npy(header("<f8"), "", 2).substr(0, 11)), HasSubstr("within the header"));
  EXPECT_THAT(problem(npy("", data)), HasSubstr("'{'"));
  EXPECT_THAT(problem(npy("{}", data)), HasSubstr("lacks one"));
  EXPECT_THAT(problem(npy("{'descr': '<f8', 'shape': (2, 3)}", data)), HasSubstr("lacks one"));
  EXPECT_THAT(problem(npy("{'descr': '<f8", data)), HasSubstr("without end"));
  EXPECT_THAT(problem(npy("{'colour': 1}", data)), HasSubstr("unknown key 'colour'"));
  EXPECT_THAT(problem(npy("{'descr': [('x', '<f8')], ", data)), HasSubstr("records"));
  EXPECT_THAT(problem(npy(header("<f8", "1"), data)), HasSubstr("neither True nor False"));
  EXPECT_THAT(problem_of_shape("(2, x)"), HasSubstr("tuple of numbers"));
  EXPECT_THAT(problem_of_shape("(2, 3"), HasSubstr("tuple of numbers"));
  EXPECT_THAT(problem_of_shape("(2,)"), HasSubstr("two dimensions"));
  EXPECT_THAT(problem_of_shape("()"), HasSubstr("two dimensions"));
  EXPECT_THAT(problem_of_shape("(0, 3)"), HasSubstr("two dimensions"));
  EXPECT_THAT(problem_of_shape("(2, 3, 1)"), HasSubstr("two dimensions"));
  EXPECT_THAT(problem_of_shape("(99999999999999999999999, 3)"), HasSubstr("too large"));
  EXPECT_THAT(problem_of_shape("(1000000000, 1000000000)"), HasSubstr("ends before the last"));
  EXPECT_THAT(problem(npy(header("<f8"), data.substr(0, 47))), HasSubstr("ends before the last"));
  for (const std::string type : {">f8", "<c16", "<f2", "|O", "<U3", "=f8", "|f8", ""}) {
    EXPECT_THAT(problem(npy(header(type), data)), HasSubstr("'" + type + "'"));
  }
}

TEST(NpyReader, TakesNanAndNegativeCellsOfAMapAsOccupied) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string data = bytes_of(std::vector<double>{nan, -1, 0, 0.4, 1, 100});
  EXPECT_THAT(read_map(file_with("map.npy", npy(header("<f8"), data))).occupied().values(),
              ElementsAre(0, 1, 1, 1, 1, 0));
}

struct Eudora {
  const char* metres_per_cell;
  int width;
  int height;
};
class EudoraTest : public ::testing::TestWithParam<Eudora> {};

TEST_P(EudoraTest, LoadsTheGridOfCoarseMapNavigation) {
  const std::string path = data_file(std::string{"gibson/Eudora_map_binary_arr_mpp_"} +
                                     GetParam().metres_per_cell + ".npy");
  CMN_NEEDS_DATA(path);
  const CoarseMap map = read_map(path, 0.3);
  EXPECT_EQ(map.width(), GetParam().width);
  EXPECT_EQ(map.height(), GetParam().height);
  EXPECT_GT(map.free_count(), map.occupied().size() / 5);
}
INSTANTIATE_TEST_SUITE_P(NpyReader, EudoraTest,
                         ::testing::Values(Eudora{"03", 23, 18}, Eudora{"04", 17, 13},
                                           Eudora{"05", 14, 11}));

}  // namespace
}  // namespace cmn
