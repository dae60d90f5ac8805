// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_file.hpp"

#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <hdf5.h>

namespace cmn {
namespace {

constexpr const char* kFormat = "coarse_map_nav examples 1";
/// [view][row][column][channel]
using PanoramaBytes = std::array<std::uint8_t, kViewCount * kViewSide * kViewSide * 3>;

/// An identifier of the library, given back by its own closing function.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_{id}, close_{close} {}
  Handle(Handle&& other) noexcept : id_{std::exchange(other.id_, -1)}, close_{other.close_} {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }
  hid_t get() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// The library's own reports on stderr are ours to word.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}
void check(bool is_well, const std::string& path, const std::string& what) {
  if (!is_well) {
    fail(path, what);
  }
}

/// An array of the file: its name, element type and the shape of one example.
struct Layout {
  const char* name;
  hid_t type;
  std::vector<hsize_t> shape;
};
Layout panorama_layout() {
  return {"panorama", H5T_NATIVE_UINT8, {kViewCount, kViewSide, kViewSide, 3}};
}
Layout near_layout() { return {"near", H5T_NATIVE_UINT8, {kNearSize, kNearSize}}; }
Layout wide_layout() { return {"wide", H5T_NATIVE_UINT8, {kWideSize, kWideSize}}; }
Layout camera_layout() { return {"camera", H5T_NATIVE_FLOAT, {3}}; }

std::vector<hsize_t> with_count(hsize_t count, std::vector<hsize_t> shape) {
  shape.insert(shape.begin(), count);
  return shape;
}

/// Reads or writes the place of example `index` in an array.
template <class Transfer>
bool transfer(const Handle& array, const Layout& layout, hsize_t index, Transfer&& act) {
  const std::vector<hsize_t> one = with_count(1, layout.shape);
  std::vector<hsize_t> start(one.size(), 0);
  start[0] = index;
  const Handle memory{H5Screate_simple(static_cast<int>(one.size()), one.data(), nullptr),
                      H5Sclose};
  const Handle space{H5Dget_space(array.get()), H5Sclose};
  return memory.is_open() && space.is_open() &&
         H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, one.data(),
                             nullptr) >= 0 &&
         act(array.get(), memory.get(), space.get()) >= 0;
}
bool write_one(const Handle& array, const Layout& layout, hsize_t index, const void* data) {
  return transfer(array, layout, index, [&](hid_t to, hid_t memory, hid_t space) {
    return H5Dwrite(to, layout.type, memory, space, H5P_DEFAULT, data);
  });
}
bool read_one(const Handle& array, const Layout& layout, hsize_t index, void* data) {
  return transfer(array, layout, index, [&](hid_t from, hid_t memory, hid_t space) {
    return H5Dread(from, layout.type, memory, space, H5P_DEFAULT, data);
  });
}

/// How files are opened: every example is read once an epoch, a cache would only take memory.
Handle without_cache() {
  Handle how{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  H5Pset_cache(how.get(), 0, 0, 0, 0.0);
  return how;
}

/// How files are made: of a version that has checksums on all that the library steers by.
Handle with_checksums() {
  Handle how{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  H5Pset_libver_bounds(how.get(), H5F_LIBVER_V110, H5F_LIBVER_LATEST);
  return how;
}

/// A new array, a chunk an example, with a checksum on each. Truths shrink to a fiftieth, pictures
/// hardly: left as they are.
Handle create_array(const Handle& file, const Layout& layout, hsize_t count, bool is_packed) {
  const std::vector<hsize_t> shape = with_count(count, layout.shape);
  const std::vector<hsize_t> chunk = with_count(1, layout.shape);
  const auto rank = static_cast<int>(shape.size());
  const Handle space{H5Screate_simple(rank, shape.data(), nullptr), H5Sclose};
  const Handle how{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
  H5Pset_chunk(how.get(), rank, chunk.data());
  H5Pset_fletcher32(how.get());
  if (is_packed) {
    H5Pset_deflate(how.get(), 1);
  }
  return {H5Dcreate2(file.get(), layout.name, layout.type, space.get(), H5P_DEFAULT, how.get(),
                     H5P_DEFAULT),
          H5Dclose};
}

Handle open_array(const std::string& path, const Handle& file, const Layout& layout,
                  hsize_t* count) {
  Handle array{H5Dopen2(file.get(), layout.name, H5P_DEFAULT), H5Dclose};
  check(array.is_open(), path, std::string{"has no array \""} + layout.name + "\"");
  const Handle space{H5Dget_space(array.get()), H5Sclose};
  std::vector<hsize_t> shape(layout.shape.size() + 1, 0);
  const bool is_of_rank =
      H5Sget_simple_extent_ndims(space.get()) == static_cast<int>(shape.size()) &&
      H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr) >= 0;
  check(is_of_rank && shape == with_count(shape[0], layout.shape), path,
        std::string{"its array \""} + layout.name + "\" has another shape than this version reads");
  check(*count == 0 || *count == shape[0], path, "its arrays hold different numbers of examples");
  *count = shape[0];
  return array;
}

bool write_attributes(const Handle& file, std::uint32_t house_seed) {
  const Handle scalar{H5Screate(H5S_SCALAR), H5Sclose};
  const Handle text{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(text.get(), std::char_traits<char>::length(kFormat));
  const Handle format{
      H5Acreate2(file.get(), "format", text.get(), scalar.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose};
  const Handle seed{H5Acreate2(file.get(), "house_seed", H5T_NATIVE_UINT32, scalar.get(),
                               H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose};
  return format.is_open() && seed.is_open() && H5Awrite(format.get(), text.get(), kFormat) >= 0 &&
         H5Awrite(seed.get(), H5T_NATIVE_UINT32, &house_seed) >= 0;
}

/// "" when there is none.
std::string read_format(const Handle& file) {
  const Handle format{H5Aopen(file.get(), "format", H5P_DEFAULT), H5Aclose};
  if (!format.is_open()) {
    return "";
  }
  const Handle type{H5Aget_type(format.get()), H5Tclose};
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
    return "";
  }
  std::string text(H5Tget_size(type.get()), '\0');
  return H5Aread(format.get(), type.get(), text.data()) >= 0 ? text : "";
}

PanoramaBytes bytes_of(const ColorPanorama& panorama) {
  PanoramaBytes bytes{};
  auto to = bytes.begin();
  for (const cv::Mat& view : panorama.views) {
    assert(view.type() == CV_8UC3 && view.rows == kViewSide && view.cols == kViewSide);
    for (int row = 0; row < view.rows; ++row) {
      const auto* from = view.ptr<std::uint8_t>(row);
      to = std::copy(from, from + 3 * kViewSide, to);
    }
  }
  return bytes;
}

bool write_all(const Handle& file, const std::vector<Example>& examples) {
  const auto count = static_cast<hsize_t>(examples.size());
  const Handle panorama = create_array(file, panorama_layout(), count, false);
  const Handle near = create_array(file, near_layout(), count, true);
  const Handle wide = create_array(file, wide_layout(), count, true);
  const Handle camera = create_array(file, camera_layout(), count, false);
  for (hsize_t i = 0; i < count; ++i) {
    const Example& example = examples[i];
    assert(example.near.isContinuous() && example.wide.isContinuous());
    const PanoramaBytes bytes = bytes_of(example.panorama);
    const std::array<float, 3> taken{example.camera_height_m, example.tilt_rad, example.view_rad};
    if (!write_one(panorama, panorama_layout(), i, bytes.data()) ||
        !write_one(near, near_layout(), i, example.near.data) ||
        !write_one(wide, wide_layout(), i, example.wide.data) ||
        !write_one(camera, camera_layout(), i, taken.data())) {
      return false;
    }
  }
  return true;
}

}  // namespace

void write_examples(const std::string& path, std::uint32_t house_seed,
                    const std::vector<Example>& examples) {
  silence();
  const std::string unfinished = path + ".part";
  bool is_written = false;
  {
    const Handle file{
        H5Fcreate(unfinished.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, with_checksums().get()),
        H5Fclose};
    is_written = file.is_open() && write_attributes(file, house_seed) &&
                 write_all(file, examples) && H5Fflush(file.get(), H5F_SCOPE_GLOBAL) >= 0;
  }
  check(is_written, path, "cannot be written; does the folder exist, is the disk full?");
  std::filesystem::rename(unfinished, path);
}

struct ExampleFile::Hdf5 {
  std::string path;
  Handle file;
  std::uint32_t house_seed = 0;
  hsize_t count = 0;
  Handle panorama;
  Handle near;
  Handle wide;
  Handle camera;

  explicit Hdf5(const std::string& from)
      : path{from},
        file{H5Fopen(from.c_str(), H5F_ACC_RDONLY, without_cache().get()), H5Fclose},
        house_seed{read_head()},
        panorama{open_array(path, file, panorama_layout(), &count)},
        near{open_array(path, file, near_layout(), &count)},
        wide{open_array(path, file, wide_layout(), &count)},
        camera{open_array(path, file, camera_layout(), &count)} {}

  std::uint32_t read_head() {
    check(file.is_open(), path,
          std::filesystem::exists(path) ? "is no HDF5 file, or was cut off" : "does not exist");
    check(read_format(file) == kFormat, path,
          std::string{"is not of the format \""} + kFormat + "\"");
    const Handle seed{H5Aopen(file.get(), "house_seed", H5P_DEFAULT), H5Aclose};
    std::uint32_t value = 0;
    check(seed.is_open() && H5Aread(seed.get(), H5T_NATIVE_UINT32, &value) >= 0, path,
          "has no house_seed");
    return value;
  }
};

ExampleFile::ExampleFile(const std::string& path) {
  silence();
  hdf5_ = std::make_unique<Hdf5>(path);
}
ExampleFile::ExampleFile(ExampleFile&&) noexcept = default;
ExampleFile& ExampleFile::operator=(ExampleFile&&) noexcept = default;
ExampleFile::~ExampleFile() = default;

std::uint32_t ExampleFile::house_seed() const { return hdf5_->house_seed; }
std::size_t ExampleFile::size() const { return static_cast<std::size_t>(hdf5_->count); }

Example ExampleFile::read(std::size_t index) const {
  assert(index < size());
  Example example;
  PanoramaBytes bytes{};
  std::array<float, 3> taken{};
  const auto i = static_cast<hsize_t>(index);
  check(read_one(hdf5_->panorama, panorama_layout(), i, bytes.data()) &&
            read_one(hdf5_->near, near_layout(), i, example.near.data) &&
            read_one(hdf5_->wide, wide_layout(), i, example.wide.data) &&
            read_one(hdf5_->camera, camera_layout(), i, taken.data()),
        hdf5_->path, "example " + std::to_string(index) + " cannot be read; is the file damaged?");
  const std::uint8_t* from = bytes.data();
  for (cv::Mat& view : example.panorama.views) {
    std::copy(from, from + 3 * kViewSide * kViewSide, view.data);
    from += 3 * kViewSide * kViewSide;
  }
  example.camera_height_m = taken[0];
  example.tilt_rad = taken[1];
  example.view_rad = taken[2];
  return example;
}

}  // namespace cmn
