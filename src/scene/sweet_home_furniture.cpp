// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/scene/furniture_meshes.hpp"
#include "coarse_map_nav/scene/mesh_reader.hpp"
#include "coarse_map_nav/scene/zip_archive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace cmn {
namespace {

namespace fs = std::filesystem;

/// Finer meshes cost more than they show.
constexpr std::size_t kMostTriangles = 60'000;
/// A side may be stretched so much more or less than the others, and the whole by so much.
constexpr double kMostShear = 1.35;
constexpr double kMostStretch = 1.5;

/// What a kind of our furniture is called in the catalogues; CATEGORY/NAME or NAME.
const std::vector<std::string>& names_of(const std::string& kind) {
  static const std::map<std::string, std::vector<std::string>> kNames{
      {"armchair", {"Armchair", "Modern armchair", "Winchester armchair"}},
      {"basin", {"Washbasin", "Vanity"}},
      {"bathtub", {"Bath", "Island bath"}},
      {"bed", {"Bed", "Iron bed", "Captain's bed", "Child bed"}},
      {"bookshelf", {"Bookcase", "Full bookcase", "Shelves"}},
      {"cabinet", {"Cupboard", "High cabinet", "Vertical shelves"}},
      {"chair", {"Living room/Chair", "Oak chair", "Osaka chair", "Plastic chair"}},
      {"coats", {"Clothes rack", "Hanging clothes"}},
      {"coffee table", {"Coffee table"}},
      {"counter", {"Lower cabinet", "Drawers cabinet", "Small lower cabinet"}},
      {"cupboard", {"Cupboard", "High cabinet"}},
      {"desk", {"Desk", "Desk table", "Wooden desk"}},
      {"dresser", {"Dresser with drawers", "Chest"}},
      {"fridge", {"Fridge", "Large fridge", "Refrigerator"}},
      {"nightstand", {"Bedside table"}},
      {"office chair", {"Office/Chair", "Office/Armchair"}},
      {"plant", {"Decorative plant", "Plant", "Ficus", "Yucca", "Bamboo", "Indoor plant"}},
      {"shelf", {"Shelves", "Vertical shelves", "Bookcase"}},
      {"shoe cabinet", {"Drawers cabinet", "Chest"}},
      {"shower", {"Shower stall"}},
      {"sideboard", {"Dresser with drawers", "Chest"}},
      {"sink", {"Sink cabinet", "Sink"}},
      {"sofa",
       {"Sofa", "Couch", "Clear sofa", "Burlap sofa", "Sofa 2 seats", "Sofa 3 seats",
        "Winchester sofa", "Futon couch"}},
      {"stove", {"Large stove", "Oven"}},
      {"table",
       {"Table", "Wooden table", "Wooden alder table", "Wooden teak table", "Black table",
        "Oak table", "Round table", "Table on trestles", "Folding table"}},
      {"toilet", {"Toilets unit"}},
      {"TV", {"TV", "Wall flat TV"}},
      {"TV stand", {"TV stand"}},
      {"wall cupboard", {"Upper cabinet", "Glass door cabinet"}},
      {"wardrobe", {"Wardrobe", "High cabinet"}},
      {"washing machine", {"Clothes washing machine", "Washing machine", "Dryer machine"}}};
  static const std::vector<std::string> kNone;
  const auto at = kNames.find(kind);
  return at == kNames.end() ? kNone : at->second;
}

/// A piece of a catalogue. Its model has y up and faces along z.
struct Article {
  std::string name;
  std::string category;
  std::string model;                                   ///< file in the archive
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();    ///< from back to front, across, height
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of the model's own axes
  const ZipArchive* archive = nullptr;
};

/// The figure of a line; 0 when it is none.
double number_of(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

void set(Article& article, const std::string& key, const std::string& value) {
  constexpr double kCentimetre = 0.01;
  if (key == "name") {
    article.name = value;
  } else if (key == "category") {
    article.category = value;
  } else if (key == "model") {
    article.model = value.substr(
        value.find_first_not_of('/') == std::string::npos ? 0 : value.find_first_not_of('/'));
  } else if (key == "depth") {
    article.size_m.x() = kCentimetre * number_of(value);
  } else if (key == "width") {
    article.size_m.y() = kCentimetre * number_of(value);
  } else if (key == "height") {
    article.size_m.z() = kCentimetre * number_of(value);
  } else if (key == "modelRotation") {
    std::istringstream figures{value};
    Eigen::Matrix3d turn;
    for (Eigen::Index i = 0; i < 9; ++i) {
      figures >> turn(i / 3, i % 3);
    }
    if (figures && turn.allFinite()) {
      article.turn = turn;
    }
  }
}

/// The articles of a catalogue (java.util.Properties: lines of key#number=value).
std::vector<Article> articles_of(const ZipArchive& archive) {
  const std::vector<std::uint8_t> bytes = archive.read("PluginFurnitureCatalog.properties");
  std::istringstream text{{bytes.begin(), bytes.end()}};
  std::map<std::string, Article> by_number;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    const std::size_t mark = line.find('#');
    const std::size_t equals = line.find('=');
    if (mark != 0 && mark < equals && equals != std::string::npos) {
      set(by_number[line.substr(mark + 1, equals - mark - 1)], line.substr(0, mark),
          line.substr(equals + 1));
    }
  }
  std::vector<Article> articles;
  for (auto& [number, article] : by_number) {
    if (article.size_m.minCoeff() > 0.0 && archive.contains(article.model)) {
      article.archive = &archive;
      articles.push_back(article);
    }
  }
  return articles;
}

class SweetHomeFurniture : public FurnitureMeshes {
 public:
  explicit SweetHomeFurniture(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
      try {
        archives_.push_back(std::make_unique<ZipArchive>(file.string()));
        const std::vector<Article> more = articles_of(*archives_.back());
        articles_.insert(articles_.end(), more.begin(), more.end());
      } catch (const std::runtime_error& e) {
        warnings_.emplace_back(e.what());
      }
    }
    meshes_.resize(articles_.size());
  }

  std::optional<MeshScene> fit(const Furniture& piece, std::mt19937_64& rng) override {
    const Eigen::Vector3d size{piece.size_x_m, piece.size_y_m, piece.size_z_m};
    std::vector<std::size_t> fitting;
    const std::vector<std::string>& names = names_of(piece.name);
    for (std::size_t i = 0; i < articles_.size(); ++i) {
      if (is_called(articles_[i], names) && is_near(articles_[i].size_m, size)) {
        fitting.push_back(i);
      }
    }
    while (!fitting.empty()) {
      const std::size_t chosen = draw_index(rng, fitting.size());
      if (const MeshScene* mesh = mesh_of(fitting[chosen])) {
        return stretched(*mesh, size, piece.elevation_m);
      }
      fitting.erase(fitting.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
    return std::nullopt;
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  static bool is_called(const Article& article, const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return name == article.name || name == article.category + "/" + article.name;
    });
  }

  static bool is_near(const Eigen::Vector3d& own, const Eigen::Vector3d& wanted) {
    const Eigen::Array3d scale = wanted.array() / own.array();
    const double mean = std::cbrt(scale.prod());
    return scale.maxCoeff() < kMostShear * mean && scale.minCoeff() * kMostShear > mean &&
           mean < kMostStretch && mean * kMostStretch > 1.0;
  }

  /// Null: it cannot be read.
  const MeshScene* mesh_of(std::size_t index) {
    std::optional<MeshScene>& mesh = meshes_[index];
    if (!mesh) {
      const Article& article = articles_[index];
      mesh.emplace();
      try {
        MeshScene read = read_mesh(*article.archive, article.model, warnings_);
        if (read.triangles.size() <= kMostTriangles) {
          // To the frame of a piece of furniture: x to where it faces, z up.
          Eigen::Matrix3d axes;
          axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
          add(*mesh, read, Eigen::Affine3d{axes * article.turn});
        }
      } catch (const std::runtime_error& e) {
        warnings_.emplace_back(e.what());
      }
    }
    return mesh->triangles.empty() ? nullptr : &*mesh;
  }

  static MeshScene stretched(const MeshScene& mesh, const Eigen::Vector3d& size,
                             double elevation_m) {
    const Eigen::AlignedBox3d box = mesh.bounds().cast<double>();
    const Eigen::Vector3d scale = size.cwiseQuotient(box.sizes().cwiseMax(1e-6));
    const Eigen::Vector3d foot{box.center().x(), box.center().y(), box.min().z()};
    MeshScene made;
    add(made, mesh,
        Eigen::Translation3d{0.0, 0.0, elevation_m} * Eigen::Scaling(scale) *
            Eigen::Translation3d{-foot});
    return made;
  }

  std::vector<std::unique_ptr<ZipArchive>> archives_;
  std::vector<Article> articles_;
  std::vector<std::optional<MeshScene>> meshes_;  ///< of the articles; without triangles: unusable
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<FurnitureMeshes> open_furniture(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".sh3f") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files.empty() ? nullptr : std::make_unique<SweetHomeFurniture>(files);
}

}  // namespace cmn
