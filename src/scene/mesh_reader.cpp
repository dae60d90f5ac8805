// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/mesh_reader.hpp"

#include "coarse_map_nav/scene/texture.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace cmn {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 256U << 20U;  // [bytes]
constexpr std::size_t kMostTriangles = 4'000'000;
constexpr unsigned kLongestRead_s = 120;

/// The files of an archive, as assimp asks for them.
class ZippedFiles : public Assimp::IOSystem {
 public:
  explicit ZippedFiles(const ZipArchive& archive) : archive_{archive} {}

  bool Exists(const char* file) const override { return archive_.contains(normal(file)); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* /*mode*/) override {
    const std::vector<std::uint8_t> bytes = archive_.read(normal(file));
    if (bytes.empty()) {
      return nullptr;
    }
    auto* copy = new std::uint8_t[bytes.size()];
    std::copy(bytes.begin(), bytes.end(), copy);
    return new Assimp::MemoryIOStream{copy, bytes.size(), true};
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  static std::string normal(const char* file) {
    return fs::path{file}.lexically_normal().generic_string();
  }
  const ZipArchive& archive_;
};

/// What a mesh is read with: its files, its name in messages, and the list for what went wrong.
struct Reading {
  Assimp::IOSystem& files;
  std::string path;  ///< as `files` knows it
  std::string name;  ///< for people
  std::vector<std::string>& warnings;

  void warn(const std::string& what) const { warnings.push_back(name + ": " + what); }
};

struct CloseStream {
  Assimp::IOSystem& files;
  void operator()(Assimp::IOStream* stream) const { files.Close(stream); }
};

/// The bytes of a file; none when there is no such file or it is too long to be meant.
std::vector<std::uint8_t> bytes_of(Assimp::IOSystem& files, const std::string& path) {
  const std::unique_ptr<Assimp::IOStream, CloseStream> stream{files.Open(path.c_str(), "rb"),
                                                              CloseStream{files}};
  if (!stream || stream->FileSize() == 0 || stream->FileSize() > kLargestFile) {
    return {};
  }
  std::vector<std::uint8_t> bytes(stream->FileSize());
  bytes.resize(stream->Read(bytes.data(), 1, bytes.size()));
  return bytes;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

/// Where a texture may lie, the likeliest first. A name may come from another machine, even from
/// one with drive letters.
std::vector<std::string> places_of(const std::string& texture, const std::string& mesh_path) {
  std::string path = texture;
  std::replace(path.begin(), path.end(), '\\', '/');
  if (path.rfind("file://", 0) == 0) {
    path.erase(0, 7);
  }
  const std::string folder = folder_of(mesh_path);
  const std::string base = path.substr(folder_of(path).size());
  std::vector<std::string> places{folder + path, folder + base,
                                  folder + "../materials/textures/" + base};
  if (!path.empty() && path[0] == '/') {
    places.insert(places.begin(), path);
  }
  return places;
}

cv::Mat decoded(const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) {
    return {};
  }
  try {
    return texture_of(cv::imdecode(bytes, cv::IMREAD_UNCHANGED));
  } catch (const cv::Exception&) {  // a picture that claims to be too large
    return {};
  }
}

/// A texture that the mesh file itself holds: a PNG or JPEG, or plain texels.
cv::Mat embedded(const aiTexture& texture) {
  if (texture.mHeight == 0) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(texture.pcData);
    return decoded({bytes, bytes + texture.mWidth});
  }
  const cv::Mat texels(static_cast<int>(texture.mHeight), static_cast<int>(texture.mWidth), CV_8UC4,
                       texture.pcData);
  return texture_of(texels);
}

cv::Mat read_texture(const Reading& reading, const aiScene& read, const std::string& texture) {
  if (const aiTexture* inside = read.GetEmbeddedTexture(texture.c_str())) {
    cv::Mat made = embedded(*inside);
    if (made.empty()) {
      reading.warn("its texture " + texture + " is no picture; its colour is taken instead");
    }
    return made;
  }
  for (const std::string& place : places_of(texture, reading.path)) {
    if (!reading.files.Exists(place.c_str())) {
      continue;
    }
    cv::Mat made = decoded(bytes_of(reading.files, place));
    if (made.empty()) {
      reading.warn("its texture " + place + " is no picture that OpenCV reads; its colour is " +
                   "taken instead");
    }
    return made;
  }
  reading.warn("there is no texture " + texture + "; its colour is taken instead");
  return {};
}

Material material_of(const Reading& reading, const aiScene& read, const aiMaterial& from) {
  Material made;
  aiString name;
  if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) {
    made.name = name.C_Str();
  }
  aiColor3D colour;
  if (from.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
    made.colour = {colour.r, colour.g, colour.b};
    if (!made.colour.allFinite()) {
      made.colour.setConstant(0.7F);
    }
  }
  float opacity = 1.0F;
  // 0 stands in files whose writers meant "not transparent": nobody models what cannot be seen.
  if (from.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity > 0.01F) {
    made.opacity = opacity;
  }
  for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}) {
    aiString texture;
    if (from.GetTexture(type, 0, &texture) == AI_SUCCESS && texture.length > 0) {
      made.texture = read_texture(reading, read, texture.C_Str());
      break;
    }
  }
  return made;
}

/// Adds one of assimp's meshes; returns how many of its triangles were broken.
std::size_t add_mesh(MeshScene& scene, const aiMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    if (mesh.HasNormals()) {
      normal = {mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z};
      normal = normal.allFinite() && normal.norm() > 1e-6F
                   ? Eigen::Vector3f{normal.normalized()}
                   : Eigen::Vector3f{Eigen::Vector3f::Zero()};
    }
    Eigen::Vector2f texture_point = Eigen::Vector2f::Zero();
    if (mesh.HasTextureCoords(0)) {
      texture_point = {mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y};
    }
    scene.vertices.emplace_back(p.x, p.y, p.z);
    scene.normals.push_back(normal);
    scene.texture_points.push_back(texture_point);
  }
  std::size_t broken = 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) {
      ++broken;
      continue;
    }
    Triangle triangle;
    triangle.material = mesh.mMaterialIndex;
    bool is_sound = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_sound = is_sound && face.mIndices[k] < mesh.mNumVertices;
      triangle.corners[k] = first + face.mIndices[k];
    }
    is_sound =
        is_sound && std::all_of(triangle.corners.begin(), triangle.corners.end(),
                                [&](std::uint32_t c) { return scene.vertices[c].allFinite(); });
    if (is_sound) {
      scene.triangles.push_back(triangle);
    }
    broken += !is_sound;
  }
  return broken;
}

bool is_y_up(const std::string& path) {
  std::string ending = fs::path{path}.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  // glTF by definition; of COLLADA assimp makes it so, and metres as well.
  return ending == ".dae" || ending == ".gltf" || ending == ".glb";
}

/// None when assimp says that there is an error.
const aiScene* import_with(Assimp::Importer& importer, const std::string& path) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  return importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                     aiProcess_SortByPType | aiProcess_GenSmoothNormals |
                                     aiProcess_JoinIdenticalVertices);
}

/// Whether assimp comes to an end with the file, be it with an error. It reads beyond the arrays of
/// some broken files (5.2.5: of COLLADA that are shorter than they say), so that the end may be
/// that of the process: another process tries first.
bool is_survived(const std::string& path) {
  const pid_t child = fork();
  if (child < 0) {
    throw std::system_error{errno, std::generic_category(), "cannot try to read " + path};
  }
  if (child == 0) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGALRM}) {
      std::signal(signal, SIG_DFL);
    }
    alarm(kLongestRead_s);
    std::freopen("/dev/null", "w", stderr);
    Assimp::Importer importer;
    import_with(importer, path);
    _exit(EXIT_SUCCESS);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
}

MeshScene read_with(const Reading& reading, Assimp::Importer& importer) {
  const aiScene* read = import_with(importer, reading.path);
  if (read == nullptr) {
    throw std::runtime_error(reading.name + ": " + importer.GetErrorString());
  }
  std::size_t triangles = 0;
  for (unsigned i = 0; i < read->mNumMeshes; ++i) {
    triangles += read->mMeshes[i]->mNumFaces;
  }
  if (triangles > kMostTriangles) {
    throw std::runtime_error(reading.name + ": " + std::to_string(triangles) +
                             " triangles are more than the " + std::to_string(kMostTriangles) +
                             " that a mesh may have");
  }
  MeshScene part;
  for (unsigned i = 0; i < read->mNumMaterials; ++i) {
    part.add_material(material_of(reading, *read, *read->mMaterials[i]));
  }
  std::size_t broken = 0;
  for (unsigned i = 0; i < read->mNumMeshes; ++i) {
    broken += add_mesh(part, *read->mMeshes[i]);
  }
  if (part.triangles.empty()) {
    throw std::runtime_error(reading.name + ": no triangle in it");
  }
  if (broken > 0) {
    reading.warn(std::to_string(broken) + " broken triangles are left out");
  }
  if (!is_y_up(reading.path)) {
    return part;
  }
  MeshScene upright;
  add(upright, part, Eigen::Affine3d{Eigen::AngleAxisd{0.5 * EIGEN_PI, Eigen::Vector3d::UnitX()}});
  return upright;
}

}  // namespace

MeshScene read_mesh(const std::string& path, std::vector<std::string>& warnings) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) {
    throw std::runtime_error(path + ": " + error.message());
  }
  if (size > kLargestFile) {
    throw std::runtime_error(path + ": larger than the 256 MB that a mesh may have");
  }
  if (!is_survived(path)) {
    throw std::runtime_error(path + ": so broken that the reader of meshes crashes");
  }
  Assimp::DefaultIOSystem files;
  Assimp::Importer importer;
  return read_with({files, path, path, warnings}, importer);
}

MeshScene read_mesh(const ZipArchive& archive, const std::string& file,
                    std::vector<std::string>& warnings) {
  if (!archive.contains(file)) {
    throw std::runtime_error(archive.path() + ": no " + file + " in it");
  }
  Assimp::Importer importer;
  auto* files = new ZippedFiles{archive};
  importer.SetIOHandler(files);  // the importer owns it from here on
  return read_with({*files, file, archive.path() + "/" + file, warnings}, importer);
}

}  // namespace cmn
