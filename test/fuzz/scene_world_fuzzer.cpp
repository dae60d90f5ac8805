// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any Gazebo world, or model beside a world -> a scene and the map of it. Not meshes: they are
/// assimp's, which is not made to withstand them (5.2.5 reads beyond the arrays of a COLLADA file
/// that are shorter than they say).
#include "coarse_map_nav/scene/sdf_reader.hpp"
#include "coarse_map_nav/scene/slice.hpp"

#include <filesystem>
#include <stdexcept>

#include "fuzz_files.hpp"
#include "fuzz_input.hpp"

namespace cmn {
namespace {

const std::string kHead = "<?xml version='1.0'?><sdf version='1.6'>";
const std::string kFloor =
    "<model name='f'><static>1</static><link name='l'><visual name='v'><geometry><plane>"
    "<normal>0 0 1</normal><size>4 4</size></plane></geometry></visual></link></model>";
const std::string kWorld = kHead + "<world name='w'>" + kFloor +
                           "<include><uri>model://chair</uri></include></world></sdf>";

const std::string kModel =
    kHead +
    "<model name='chair'><pose>1 0 0 0 0 1</pose><link name='l'><visual name='v'><geometry><mesh>"
    "<uri>model://chair/mesh.obj</uri></mesh></geometry></visual></link></model></sdf>";
const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 1\nvt 0 0\nvt 1 1\nf 1/1 2/2 3/1\n";
/// By the first byte: a world, or a model in a world. Returns the path of the world.
std::string write_case(const FuzzFolder& folder, std::uint8_t kind, const std::string& content) {
  std::filesystem::create_directories(folder.path() / "models/chair");
  folder.write("models/chair/model.config",
               "<model><name>chair</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder.write("models/chair/mesh.obj", kTriangle);
  folder.write("models/chair/model.sdf", kind % 2 == 1 ? content : kModel);
  return folder.write("test.world", kind % 2 == 0 ? content : kWorld);
}

}  // namespace

std::vector<std::string> fuzz_seeds() {
  const std::string shapes =
      kHead + "<world name='w'>" + kFloor +
      "<light name='s' type='spot'><pose>0 0 2 0 0 0</pose><diffuse>1 1 1 1</diffuse><direction>0 "
      "0 -1</direction><attenuation><range>5</range><constant>1</constant><linear>0</linear>"
      "<quadratic>1</quadratic></attenuation><spot><inner_angle>1</inner_angle><outer_angle>2"
      "</outer_angle><falloff>1</falloff></spot></light><model name='m'><link name='l'>"
      "<visual name='a'><geometry><box><size>1 1 1</size></box></geometry><material><diffuse>1 0 0 "
      "1</diffuse></material></visual><visual name='b'><pose>1 1 0 0 0 0</pose><geometry><cylinder>"
      "<radius>0.2</radius><length>1</length></cylinder></geometry></visual><visual name='c'>"
      "<geometry><sphere><radius>0.3</radius></sphere></geometry></visual></link></model></world>"
      "</sdf>";
  return {std::string(1, '\0') + kWorld, std::string(1, '\0') + shapes, "\1" + kModel};
}

}  // namespace cmn

/// sdformat keeps the documents of worlds that it gave up on, and makes so many small things for
/// each that a full quarantine of what was freed costs a third of the time and more.
extern "C" const char* __asan_default_options() { return "detect_leaks=0:quarantine_size_mb=8"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  static const cmn::FuzzFolder folder;
  const std::string path = cmn::write_case(
      folder, data[0], std::string{reinterpret_cast<const char*>(data) + 1, size - 1});
  std::vector<std::string> warnings;
  cmn::MeshScene scene;
  try {
    scene = cmn::read_sdf(path, warnings);
  } catch (const std::runtime_error& e) {
    cmn::require(std::string{e.what()}.find(path) == 0, "errors name the file");
    return 0;
  }
  cmn::require(!scene.triangles.empty(), "a scene has surfaces");
  for (const cmn::Triangle& triangle : scene.triangles) {
    cmn::require(triangle.material < scene.materials.size(), "surfaces are painted");
    for (const std::uint32_t corner : triangle.corners) {
      cmn::require(corner < scene.vertices.size(), "triangles have corners");
      cmn::require(scene.vertices[corner].allFinite(), "corners are somewhere");
    }
  }
  try {
    cmn::SliceParams params;
    params.resolution_m = 0.5;
    cmn::require(cmn::slice(scene, params).free_count() > 0, "a slice has a free cell");
  } catch (const std::runtime_error&) {
    return 0;  // no floor, or too large
  }
  return 0;
}
