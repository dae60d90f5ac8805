// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/mesh_reader.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace cmn {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One triangle with corners (0, 0, 0), (1, 0, 0), (0, 2, 0) in the file's own axes and unit.
std::string collada(const std::string& up, const std::string& unit) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit meter='" +
         unit + "' name='u'/><up_axis>" + up +
         "</up_axis></asset><library_geometries><geometry id='g'><mesh><source id='p'>"
         "<float_array id='a' count='9'>0 0 0 1 0 0 0 2 0</float_array><technique_common>"
         "<accessor source='#a' count='3' stride='3'><param name='X' type='float'/>"
         "<param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
         "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/>"
         "</vertices><triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id='s'><node id='n'><instance_geometry url='#g'/>"
         "</node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url='#s'/></scene></COLLADA>";
}

Eigen::Vector3f size_of(const std::string& path) {
  std::vector<std::string> warnings;
  return read_mesh(path, warnings).bounds().sizes();
}

TEST(MeshReader, ColladaComesOutZUpInMetres) {
  EXPECT_TRUE(
      size_of(file_with("z.dae", collada("Z_UP", "1"))).isApprox(Eigen::Vector3f{1, 2, 0}, 1e-5F));
  EXPECT_TRUE(size_of(file_with("cm.dae", collada("Z_UP", "0.01")))
                  .isApprox(Eigen::Vector3f{0.01F, 0.02F, 0}, 1e-5F));
  // The file's y is the height.
  EXPECT_TRUE(
      size_of(file_with("y.dae", collada("Y_UP", "1"))).isApprox(Eigen::Vector3f{1, 0, 2}, 1e-5F));
}

TEST(MeshReader, ObjComesOutAsItIs) {
  EXPECT_TRUE(size_of(file_with("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n"))
                  .isApprox(Eigen::Vector3f{1, 2, 3}, 1e-5F));
}

TEST(MeshReader, ColoursAndTexturesComeWithTheMesh) {
  const std::string picture = file_with("t.png", "");
  cv::imwrite(picture, cv::Mat(4, 8, CV_8UC3, cv::Scalar{10, 20, 30}));
  const std::string base = std::filesystem::path{picture}.filename().string();
  const std::string library = file_with(
      "a.mtl", "newmtl painted\nKd 0.1 0.2 0.3\nnewmtl pictured\nmap_Kd C:\\far\\" + base + "\n");
  std::vector<std::string> warnings;
  const MeshScene scene = read_mesh(
      file_with("a.obj", "mtllib " + std::filesystem::path{library}.filename().string() +
                             "\nv 0 0 0\nv 1 0 0\nv 0 2 3\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl painted\n"
                             "f 1/1 2/2 3/3\nusemtl pictured\nf 1/1 3/3 2/2\n"),
      warnings);
  ASSERT_EQ(scene.triangles.size(), 2U);
  const auto material = [&](std::size_t i) { return scene.materials[scene.triangles[i].material]; };
  const std::size_t pictured = material(0).texture.empty() ? 1 : 0;
  EXPECT_EQ(material(pictured).texture.size(), cv::Size(8, 4));
  EXPECT_TRUE(material(1 - pictured).colour.isApprox(Eigen::Vector3f{0.1F, 0.2F, 0.3F}, 1e-4F));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(MeshReader, AMissingOrBrokenTextureIsReportedAndItsColourTaken) {
  const std::string no_picture = file_with("no_picture.png", "this is text");
  const std::string base = std::filesystem::path{no_picture}.filename().string();
  const std::string library = file_with(
      "a.mtl", "newmtl a\nKd 0.1 0.2 0.3\nmap_Kd none.png\nnewmtl b\nmap_Kd " + base + "\n");
  std::vector<std::string> warnings;
  const MeshScene scene = read_mesh(
      file_with("a.obj", "mtllib " + std::filesystem::path{library}.filename().string() +
                             "\nv 0 0 0\nv 1 0 0\nv 0 2 3\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n"),
      warnings);
  EXPECT_EQ(scene.triangles.size(), 2U);
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("there is no texture none.png")));
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("no picture that OpenCV reads")));
}

TEST(MeshReader, WhatIsNoMeshIsAnErrorThatNamesTheFile) {
  std::vector<std::string> warnings;
  for (const char* name : {"a.dae", "a.obj", "a.gltf", "a.glb", "a.stl", "a.txt"}) {
    for (const char* text : {"", "nonsense", "v 0 0 0\n", "<COLLADA>", "{\"asset\":{}}"}) {
      const std::string path = file_with(name, text);
      EXPECT_THAT(error_of([&] { read_mesh(path, warnings); }), HasSubstr(name)) << text;
    }
  }
  EXPECT_THAT(error_of([&] { read_mesh("/none/a.obj", warnings); }), HasSubstr("/none/a.obj"));
}

TEST(MeshReader, AFileThatCrashesItsReaderIsAnError) {
  // Corners far beyond the array, which says that it is long enough.
  std::string broken = collada("Z_UP", "1");
  for (const auto& [said, lie] :
       {std::pair<std::string, std::string>{"count='9'", "count='900000000'"},
        {"count='3'", "count='300000000'"},
        {"<p>0 1 2<", "<p>0 1 299999999<"}}) {
    broken.replace(broken.find(said), said.size(), lie);
  }
  std::vector<std::string> warnings;
  EXPECT_THAT(error_of([&] { read_mesh(file_with("long.dae", broken), warnings); }),
              HasSubstr("long.dae"));
}

TEST(MeshReader, BrokenTrianglesAreLeftOut) {
  std::vector<std::string> warnings;
  const MeshScene scene = read_mesh(
      file_with("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\nv nan 0 0\nf 1 2 3\nf 1 2 4\n"), warnings);
  EXPECT_EQ(scene.triangles.size(), 1U);
}

}  // namespace
}  // namespace cmn
