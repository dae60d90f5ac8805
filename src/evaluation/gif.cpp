// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/gif.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <gif_lib.h>

namespace cmn {
namespace {

constexpr int kColours = 255;
constexpr GifPixelType kUnchanged = 255;  ///< the transparent one
constexpr int kBits = 5;                  ///< of a channel that tell colours apart
constexpr std::size_t kKeys = 1U << (3 * kBits);

std::size_t key_of(const cv::Vec3b& bgr) {
  constexpr int kDrop = 8 - kBits;
  return static_cast<std::size_t>(((bgr[0] >> kDrop) << (2 * kBits)) |
                                  ((bgr[1] >> kDrop) << kBits) | (bgr[2] >> kDrop));
}

/// The colours most used, and for every key the nearest of them.
struct Palette {
  std::vector<cv::Vec3b> colours;
  std::vector<GifPixelType> nearest;
};

Palette palette_of(const std::vector<FilmFrame>& frames) {
  std::vector<std::uint64_t> count(kKeys, 0);
  std::vector<std::array<std::uint64_t, 3>> sum(kKeys, {0, 0, 0});
  for (const FilmFrame& frame : frames) {
    for (int y = 0; y < frame.picture.rows; ++y) {
      const auto* row = frame.picture.ptr<cv::Vec3b>(y);
      for (int x = 0; x < frame.picture.cols; ++x) {
        const std::size_t key = key_of(row[x]);
        ++count[key];
        for (int c = 0; c < 3; ++c) {
          sum[key][static_cast<std::size_t>(c)] += row[x][c];
        }
      }
    }
  }
  std::vector<std::size_t> keys(kKeys);
  std::iota(keys.begin(), keys.end(), 0U);
  std::partial_sort(keys.begin(), keys.begin() + kColours, keys.end(),
                    [&](std::size_t a, std::size_t b) {
                      return count[a] != count[b] ? count[a] > count[b] : a < b;
                    });
  const auto mean_of = [&](std::size_t key) {
    cv::Vec3b mean;
    for (int c = 0; c < 3; ++c) {
      mean[c] =
          cv::saturate_cast<uchar>(static_cast<double>(sum[key][static_cast<std::size_t>(c)]) /
                                   static_cast<double>(std::max<std::uint64_t>(1, count[key])));
    }
    return mean;
  };
  Palette palette;
  for (int i = 0; i < kColours && count[keys[static_cast<std::size_t>(i)]] > 0; ++i) {
    palette.colours.push_back(mean_of(keys[static_cast<std::size_t>(i)]));
  }
  palette.nearest.assign(kKeys, 0);
  for (std::size_t key = 0; key < kKeys; ++key) {
    if (count[key] == 0) {
      continue;
    }
    const cv::Vec3b wanted = mean_of(key);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < palette.colours.size(); ++i) {
      const double distance = cv::norm(cv::Vec3d(wanted), cv::Vec3d(palette.colours[i]));
      if (distance < least) {
        least = distance;
        palette.nearest[key] = static_cast<GifPixelType>(i);
      }
    }
  }
  return palette;
}

cv::Mat1b indices_of(const cv::Mat& picture, const Palette& palette) {
  cv::Mat1b indices(picture.size());
  for (int y = 0; y < picture.rows; ++y) {
    const auto* row = picture.ptr<cv::Vec3b>(y);
    std::transform(row, row + picture.cols, indices.ptr<uchar>(y),
                   [&](const cv::Vec3b& bgr) { return palette.nearest[key_of(bgr)]; });
  }
  return indices;
}

/// The smallest rectangle around all that changed; one pixel when nothing did.
cv::Rect changed_area(const cv::Mat1b& before, const cv::Mat1b& now) {
  const cv::Mat changed = before != now;
  cv::Mat columns;
  cv::Mat rows;
  cv::reduce(changed, columns, 0, cv::REDUCE_MAX);
  cv::reduce(changed, rows, 1, cv::REDUCE_MAX);
  std::vector<cv::Point> x;
  std::vector<cv::Point> y;
  if (cv::countNonZero(columns) == 0) {
    return {0, 0, 1, 1};
  }
  cv::findNonZero(columns, x);
  cv::findNonZero(rows, y);
  return {cv::Point{x.front().x, y.front().y}, cv::Point{x.back().x + 1, y.back().y + 1}};
}

/// giflib's calls, their failures as exceptions.
class GifFile {
 public:
  GifFile(std::string path, cv::Size size, const Palette& palette)
      : path_{std::move(path)}, stream_{path_, std::ios::binary} {
    if (!stream_) {
      throw std::runtime_error(path_ + ": cannot be opened for writing");
    }
    int error = 0;
    file_ = EGifOpen(&stream_, &GifFile::write, &error);
    if (file_ == nullptr) {
      throw std::runtime_error(path_ + ": giflib failed with error " + std::to_string(error));
    }
    const std::unique_ptr<ColorMapObject, void (*)(ColorMapObject*)> colours{
        GifMakeMapObject(256, nullptr), &GifFreeMapObject};
    for (std::size_t i = 0; i < palette.colours.size(); ++i) {
      const cv::Vec3b& bgr = palette.colours[i];
      colours->Colors[i] = {bgr[2], bgr[1], bgr[0]};
    }
    EGifSetGifVersion(file_, true);
    check(EGifPutScreenDesc(file_, size.width, size.height, 8, 0, colours.get()));
    constexpr std::array<unsigned char, 3> kForEver{1, 0, 0};
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(file_, 3, kForEver.data()));
    check(EGifPutExtensionTrailer(file_));
  }
  GifFile(const GifFile&) = delete;
  GifFile& operator=(const GifFile&) = delete;
  ~GifFile() {
    if (file_ != nullptr) {
      EGifCloseFile(file_, nullptr);
    }
  }

  void add(cv::Mat1b part, cv::Point at, double duration_s) {
    GraphicsControlBlock control;
    control.DisposalMode = DISPOSE_DO_NOT;
    control.UserInputFlag = false;
    control.DelayTime = static_cast<int>(std::lround(100.0 * duration_s));
    control.TransparentColor = kUnchanged;
    std::array<GifByteType, 4> packed{};
    EGifGCBToExtension(&control, packed.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, packed.size(), packed.data()));
    check(EGifPutImageDesc(file_, at.x, at.y, part.cols, part.rows, false, nullptr));
    for (int y = 0; y < part.rows; ++y) {
      check(EGifPutLine(file_, part.ptr<uchar>(y), part.cols));
    }
  }

  void close() {
    int error = 0;
    check(EGifCloseFile(std::exchange(file_, nullptr), &error));
    stream_.close();
    check(stream_ ? GIF_OK : GIF_ERROR);
  }

 private:
  void check(int status) const {
    if (status != GIF_OK) {
      throw std::runtime_error(path_ + ": cannot be written; is the disk full?");
    }
  }

  // Not by giflib itself, which opens files that only their owner may read.
  static int write(GifFileType* file, const GifByteType* bytes, int count) {
    auto& stream = *static_cast<std::ofstream*>(file->UserData);
    stream.write(reinterpret_cast<const char*>(bytes), count);
    return stream ? count : 0;
  }

  std::string path_;
  std::ofstream stream_;
  GifFileType* file_ = nullptr;
};

}  // namespace

void write_gif(const std::string& path, const std::vector<FilmFrame>& frames) {
  if (frames.empty()) {
    throw std::invalid_argument("a film of no frames");
  }
  const cv::Size size = frames.front().picture.size();
  for (const FilmFrame& frame : frames) {
    if (frame.picture.empty() || frame.picture.type() != CV_8UC3 || frame.picture.size() != size) {
      throw std::invalid_argument("the frames of a film must be 8-bit BGR and of one size");
    }
  }
  const Palette palette = palette_of(frames);
  GifFile file{path, size, palette};
  cv::Mat1b shown;
  for (const FilmFrame& frame : frames) {
    const cv::Mat1b indices = indices_of(frame.picture, palette);
    cv::Rect area{cv::Point{}, size};
    cv::Mat1b part = indices.clone();
    if (!shown.empty()) {
      part.setTo(kUnchanged, shown == indices);
      area = changed_area(shown, indices);
    }
    file.add(part(area), area.tl(), frame.duration_s);
    shown = indices;
  }
  file.close();
}

}  // namespace cmn
