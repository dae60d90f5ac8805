// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/sdf_reader.hpp"

#include "coarse_map_nav/scene/model_folders.hpp"

#include <filesystem>
#include <fstream>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A folder of its own for the running test, with `worlds` and `models` in it.
class SdfReaderTest : public ::testing::Test {
 protected:
  SdfReaderTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path{::testing::TempDir()} / ("sdf_" + std::string{test->name()});
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "worlds");
  }

  std::string put(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream{folder_ / name} << text;
    return (folder_ / name).string();
  }
  std::string put_world(const std::string& inside) {
    return put("worlds/test.world", "<?xml version='1.0'?><sdf version='1.6'><world name='w'>" +
                                        inside + "</world></sdf>");
  }
  void put_model(const std::string& name, const std::string& inside) {
    put("models/" + name + "/model.config",
        "<?xml version='1.0'?><model><name>" + name +
            "</name><sdf version='1.6'>model.sdf</sdf></model>");
    put("models/" + name + "/model.sdf", "<?xml version='1.0'?><sdf version='1.6'><model name='" +
                                             name + "'>" + inside + "</model></sdf>");
  }
  MeshScene read(const std::string& path, SdfPart part = SdfPart::kVisual) {
    warnings_.clear();
    return read_sdf(path, warnings_, part);
  }

  fs::path folder_;
  std::vector<std::string> warnings_;
};

std::string visual(const std::string& geometry, const std::string& more = "") {
  return "<link name='l'><visual name='v'>" + more + "<geometry>" + geometry +
         "</geometry></visual></link>";
}
const std::string kBox = "<box><size>1 2 3</size></box>";  // NOLINT(cert-err58-cpp)

void expect_bounds(const MeshScene& scene, const Eigen::Vector3f& low,
                   const Eigen::Vector3f& high) {
  EXPECT_TRUE(scene.bounds().min().isApprox(low, 1e-4F)) << scene.bounds().min().transpose();
  EXPECT_TRUE(scene.bounds().max().isApprox(high, 1e-4F)) << scene.bounds().max().transpose();
}

TEST_F(SdfReaderTest, PosesOfModelLinkAndVisualAddUp) {
  const MeshScene scene = read(put_world(
      "<model name='m'><pose>10 0 0 0 0 1.5707963</pose><link name='l'><pose>2 0 0 0 0 0</pose>"
      "<visual name='v'><pose>0 0 1.5 0 0 0</pose><geometry>" +
      kBox + "</geometry></visual></link></model>"));
  // The box is 1 m along its x, which is the world's y; the link is 2 m along the world's y.
  expect_bounds(scene, {9.0F, 1.5F, 0.0F}, {11.0F, 2.5F, 3.0F});
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfReaderTest, ShapesHaveTheirSizes) {
  const auto bounds = [&](const std::string& geometry) {
    return read(put_world("<model name='m'>" + visual(geometry) + "</model>"));
  };
  expect_bounds(bounds(kBox), {-0.5F, -1.0F, -1.5F}, {0.5F, 1.0F, 1.5F});
  expect_bounds(bounds("<cylinder><radius>0.5</radius><length>2</length></cylinder>"),
                {-0.5F, -0.5F, -1.0F}, {0.5F, 0.5F, 1.0F});
  expect_bounds(bounds("<sphere><radius>2</radius></sphere>"), {-2, -2, -2}, {2, 2, 2});
  expect_bounds(bounds("<plane><normal>0 0 1</normal><size>4 6</size></plane>"), {-2, -3, 0},
                {2, 3, 0});
}

TEST_F(SdfReaderTest, ModelsAreIncludedFromTheFolderBesideTheWorlds) {
  put_model("inner", visual(kBox));
  put_model("outer", "<include><uri>model://inner</uri><pose>0 5 0 0 0 0</pose></include>");
  const MeshScene scene = read(
      put_world("<include><name>a</name><uri>model://outer</uri><pose>1 0 0 0 0 0</pose></include>"
                "<model name='b'><include><uri>model://inner</uri></include>"
                "<pose frame=''>-9 0 0 0 0 0</pose></model>"));
  EXPECT_EQ(scene.triangles.size(), 24U);
  expect_bounds(scene, {-9.5F, -1.0F, -1.5F}, {1.5F, 6.0F, 1.5F});
}

TEST_F(SdfReaderTest, MeshesAreScaled) {
  put("models/m/flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 2\nf 1 2 3\n");
  put_model("m", visual("<mesh><uri>model://m/flat.obj</uri><scale>2 3 0.5</scale></mesh>") +
                     "<link name='b'><visual name='w'><geometry><mesh><uri>flat.obj</uri></mesh>"
                     "</geometry></visual></link>");
  const MeshScene scene = read(put_world("<include><uri>model://m</uri></include>"));
  expect_bounds(scene, {0, 0, 0}, {2, 3, 2});
  EXPECT_EQ(scene.triangles.size(), 2U);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfReaderTest, CollisionsAreThereOnDemand) {
  const std::string path =
      put_world("<model name='m'><link name='l'><visual name='v'><geometry>" + kBox +
                "</geometry></visual><collision name='c'><geometry><sphere><radius>9</radius>"
                "</sphere></geometry></collision></link></model>");
  expect_bounds(read(path, SdfPart::kCollision), {-9, -9, -9}, {9, 9, 9});
  expect_bounds(read(path), {-0.5F, -1.0F, -1.5F}, {0.5F, 1.0F, 1.5F});
}

TEST_F(SdfReaderTest, ColoursAndLightsAreTaken) {
  const MeshScene scene = read(
      put_world("<scene><ambient>0.1 0.2 0.3 1</ambient></scene>"
                "<light name='sun' type='directional'><direction>0 0 -1</direction>"
                "<diffuse>0.5 0.5 0.5 1</diffuse></light>"
                "<light name='lamp' type='point'><pose>1 2 3 0 0 0</pose><diffuse>1 1 1 1</diffuse>"
                "<attenuation><range>9</range><constant>0.1</constant><linear>0.2</linear>"
                "<quadratic>0.3</quadratic></attenuation></light><model name='m'><link name='l'>"
                "<visual name='v'><geometry>" +
                kBox +
                "</geometry><transparency>0.75</transparency><material><diffuse>1 0.5 0 1</diffuse>"
                "</material></visual></link></model>"));
  EXPECT_TRUE(scene.materials.at(0).colour.isApprox(Eigen::Vector3f{1.0F, 0.5F, 0.0F}));
  EXPECT_FLOAT_EQ(scene.materials[0].opacity, 0.25F);
  EXPECT_TRUE(scene.ambient.isApprox(Eigen::Vector3f{0.1F, 0.2F, 0.3F}));
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_TRUE(scene.lights[0].is_sun);
  EXPECT_TRUE(scene.lights[1].position.isApprox(Eigen::Vector3f{1, 2, 3}));
  EXPECT_TRUE(scene.lights[1].falloff.isApprox(Eigen::Vector3f{0.1F, 0.2F, 0.3F}));
}

TEST_F(SdfReaderTest, WhatIsMissingIsReportedAndSurvived) {
  put_model("here", visual(kBox) +
                        "<link name='b'><visual name='w'><geometry><mesh><uri>model://here/no.dae"
                        "</uri></mesh></geometry></visual></link>");
  put("models/here/broken.dae", "<COLLADA><not closed");
  const MeshScene scene = read(put_world(
      "<include><uri>model://nowhere</uri></include><include><uri>model://here</uri></include>"
      "<model name='m'>" +
      visual("<mesh><uri>model://here/broken.dae</uri></mesh>") + "</model>"));
  EXPECT_EQ(scene.triangles.size(), 12U);
  EXPECT_THAT(warnings_, ::testing::Contains(HasSubstr("nowhere")));
  EXPECT_THAT(warnings_, ::testing::Contains(HasSubstr("there is no mesh model://here/no.dae")));
  EXPECT_THAT(warnings_, ::testing::Contains(HasSubstr("broken.dae")));
}

TEST_F(SdfReaderTest, AWorldWithNothingInItIsAnError) {
  EXPECT_THAT(error_of([&] { read(put_world("")); }), HasSubstr("nothing in it has a surface"));
  EXPECT_THAT(error_of([&] { read(put_world("<include><uri>model://no</uri></include>")); }),
              HasSubstr("test.world"));
}

TEST_F(SdfReaderTest, WhatIsNoSdfIsAnError) {
  for (const char* text : {"", "no xml", "<sdf", "<sdf version='1.6'></sdf>", "<a/>",
                           "<sdf version='x'><world/></sdf>", "\x01\x02\xff"}) {
    EXPECT_THAT(error_of([&] { read(put("worlds/a.world", text)); }), HasSubstr("a.world")) << text;
  }
  EXPECT_THAT(error_of([&] { read((folder_ / "none.world").string()); }),
              HasSubstr("no such file"));
  EXPECT_THAT(error_of([&] { read(folder_.string()); }), HasSubstr("no such file"));
}

TEST_F(SdfReaderTest, FiguresThatAreNoneAreLeftOut) {
  put("models/m/flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 2\nf 1 2 3\n");
  const MeshScene scene = read(put_world(
      "<model name='a'><pose>1e9 0 0 0 0 0</pose>" + visual(kBox) + "</model><model name='b'>" +
      visual("<box><size>-1 1 1</size></box>") + "</model><model name='c'>" +
      visual("<mesh><uri>model://m/flat.obj</uri><scale>0 1 1</scale></mesh>") +
      "</model><model name='d'>" + visual(kBox) + "</model>"));
  EXPECT_EQ(scene.triangles.size(), 12U);
  EXPECT_FALSE(warnings_.empty());
}

TEST_F(SdfReaderTest, IncludesThatNeverEndAreAnError) {
  put_model("a", "<include><uri>model://b</uri></include>" + visual(kBox));
  put_model("b", "<include><uri>model://a</uri></include>");
  EXPECT_THAT(error_of([&] { read(put_world("<include><uri>model://a</uri></include>")); }),
              HasSubstr("includes itself"));
}

TEST_F(SdfReaderTest, IncludesThatMultiplyAreAnError) {
  put_model("m0", visual(kBox));
  for (int i = 1; i < 8; ++i) {
    std::string ten;
    for (int k = 0; k < 10; ++k) {
      ten += "<include><name>n" + std::to_string(k) + "</name><uri>model://m" +
             std::to_string(i - 1) + "</uri></include>";
    }
    put_model("m" + std::to_string(i), ten);
  }
  EXPECT_THAT(error_of([&] { read(put_world("<include><uri>model://m7</uri></include>")); }),
              HasSubstr("20000"));
}

TEST_F(SdfReaderTest, UrisAreFoundInTheFirstFolderThatHasThem) {
  put_model("m", "");
  const std::vector<std::string> folders = model_folders((folder_ / "worlds/x.world").string());
  EXPECT_THAT(folders, ::testing::Contains((folder_ / "models").string()));
  EXPECT_EQ(find_uri("model://m", "", folders), (folder_ / "models/m").string());
  EXPECT_EQ(find_uri("model://m/model.sdf", "", folders),
            (folder_ / "models/m/model.sdf").string());
  EXPECT_EQ(find_uri("model://n", "", folders), "");
  EXPECT_EQ(find_uri("m/model.sdf", (folder_ / "models").string(), {}),
            (folder_ / "models/m/model.sdf").string());
  EXPECT_EQ(find_uri("", folder_.string(), folders), "");
}

}  // namespace
}  // namespace cmn
