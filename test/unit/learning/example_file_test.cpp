// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_file.hpp"

#include <fstream>
#include <sstream>

#include "file_fixture.hpp"
#include "learning_examples.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

TEST(ExampleFile, GivesBackWhatWasWritten) {
  std::mt19937_64 rng{2};
  std::vector<Example> examples{toy_example(rng), toy_example(rng), toy_example(rng)};
  examples[1].camera_height_m = 0.37F;
  examples[1].tilt_rad = -0.1F;
  examples[1].view_rad = 1.2F;
  const std::string path = fresh_folder("h5") + "/house.h5";
  write_examples(path, 4000000000U, examples);
  EXPECT_FALSE(exists(path + ".part"));
  const ExampleFile file{path};
  EXPECT_EQ(file.house_seed(), 4000000000U);
  ASSERT_EQ(file.size(), 3U);
  const Example read = file.read(1);
  EXPECT_EQ(cv::norm(read.near, examples[1].near, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(read.wide, examples[1].wide, cv::NORM_INF), 0.0);
  for (std::size_t k = 0; k < kViewCount; ++k) {
    EXPECT_EQ(cv::norm(read.panorama.views[k], examples[1].panorama.views[k], cv::NORM_INF), 0.0);
  }
  EXPECT_EQ(read.camera_height_m, 0.37F);
  EXPECT_EQ(read.tilt_rad, -0.1F);
  EXPECT_EQ(read.view_rad, 1.2F);
}

TEST(ExampleFile, NamesAFileThatIsAbsentOrNone) {
  EXPECT_THAT(error_of([] { ExampleFile{"/nowhere/house.h5"}; }),
              HasSubstr("/nowhere/house.h5: does not exist"));
  const std::string text = file_with("text.h5", "no HDF5 at all");
  EXPECT_THAT(error_of([&] { ExampleFile{text}; }), HasSubstr("is no HDF5 file"));
  EXPECT_THAT(error_of([] { write_examples("/nowhere/house.h5", 1, {}); }),
              HasSubstr("cannot be written"));
}

TEST(ExampleFile, NoticesAFileThatWasCutOff) {
  std::mt19937_64 rng{2};
  const std::string path = fresh_folder("h5") + "/house.h5";
  write_examples(path, 1, {toy_example(rng), toy_example(rng)});
  std::ostringstream whole;
  whole << std::ifstream{path, std::ios::binary}.rdbuf();
  for (const double share : {0.01, 0.5, 0.9}) {
    const auto bytes = static_cast<std::size_t>(share * static_cast<double>(whole.str().size()));
    const std::string cut = file_with("cut.h5", whole.str().substr(0, bytes));
    EXPECT_THAT(error_of([&] { ExampleFile{cut}.read(1); }), HasSubstr("cut.h5: ")) << share;
  }
}

TEST(ExampleFile, NoticesFlippedBytesWhereverTheyMatter) {
  std::mt19937_64 rng{2};
  const Example example = toy_example(rng);
  const std::string path = fresh_folder("h5") + "/house.h5";
  write_examples(path, 1, {example});
  std::ostringstream whole;
  whole << std::ifstream{path, std::ios::binary}.rdbuf();
  const std::string good = whole.str();
  int noticed = 0;
  for (std::size_t at = 0; at < good.size(); at += at < 3000 ? 7 : 997) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    const std::string file = file_with("damaged.h5", damaged);
    Example read;
    const std::string error = error_of([&] { read = ExampleFile{file}.read(0); });
    if (error.empty()) {  // a byte that nobody uses
      EXPECT_EQ(cv::norm(read.near, example.near, cv::NORM_INF), 0.0) << at;
      EXPECT_EQ(cv::norm(read.panorama.views[2], example.panorama.views[2], cv::NORM_INF), 0.0);
    } else {
      EXPECT_EQ(error.find(file + ": "), 0U) << error;
      ++noticed;
    }
  }
  EXPECT_GT(noticed, 50);
}

}  // namespace
}  // namespace cmn
