// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/house_picture.hpp"

#include "coarse_map_nav/evaluation/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace cmn {
namespace {

const cv::Scalar kPaper{255, 255, 255};
const cv::Scalar kInk{60, 55, 50};
const cv::Scalar kWall{75, 70, 66};
const cv::Scalar kGlass{235, 205, 160};
const cv::Scalar kFaint{150, 150, 150};

/// What a kind of furniture looks like; the first entry whose word is in the name holds.
struct Look {
  const char* word;
  const char* meaning;  ///< for the legend; nullptr: as the entry before
  cv::Scalar colour;
};
const std::array<Look, 19> kLooks{{
    {"bed", "bed", {232, 196, 170}},
    {"sofa", "sofa, armchair", {160, 205, 170}},
    {"armchair", nullptr, {160, 205, 170}},
    {"TV", "television", {120, 105, 90}},
    {"coffee table", "table, desk", {150, 195, 230}},
    {"table", nullptr, {150, 195, 230}},
    {"desk", nullptr, {150, 195, 230}},
    {"chair", "chair", {105, 150, 205}},
    {"fridge", "kitchen", {205, 205, 240}},
    {"stove", nullptr, {170, 170, 225}},
    {"sink", nullptr, {205, 205, 240}},
    {"counter", nullptr, {205, 205, 240}},
    {"bathtub", "bath", {240, 225, 180}},
    {"shower", nullptr, {240, 225, 180}},
    {"toilet", nullptr, {240, 225, 180}},
    {"basin", nullptr, {240, 225, 180}},
    {"washing machine", nullptr, {225, 215, 200}},
    {"plant", "plant", {130, 190, 120}},
    {"", "cupboard, shelf", {165, 180, 195}},
}};

const Look& look_of(const std::string& name) {
  return *std::find_if(kLooks.begin(), kLooks.end(),
                       [&](const Look& look) { return name.find(look.word) != std::string::npos; });
}

cv::Scalar floor_of(RoomPurpose purpose) {
  switch (purpose) {
    case RoomPurpose::kBath:
      return {252, 247, 240};
    case RoomPurpose::kKitchen:
      return {244, 246, 252};
    case RoomPurpose::kHall:
    case RoomPurpose::kStorage:
      return {246, 246, 246};
    default:
      return {243, 249, 252};
  }
}

/// A house on a canvas: metres -> pixels, y up.
class HousePainter {
 public:
  HousePainter(Canvas& canvas, const House& house, cv::Point2d lower_left, double scale)
      : canvas_{canvas}, house_{house}, lower_left_{lower_left}, scale_{scale} {}

  void paint(bool names_furniture);

 private:
  cv::Point2d at(Point2 p) const {
    return {lower_left_.x + scale_ * p.x, lower_left_.y - scale_ * p.y};
  }
  cv::Rect2d at(const Rectangle& a) const {
    return {at(Point2{a.x0, a.y1}), at(Point2{a.x1, a.y0})};
  }
  void outline(const std::vector<cv::Point2d>& points, const cv::Scalar& colour);
  void paint_part(const Pose2& pose, const FurniturePart& part, const cv::Scalar& colour);
  void paint(const Furniture& piece);
  void paint(const Opening& opening);
  void paint_leaf(const Opening& door);
  void name_room(std::size_t room, double most_height);
  void name_piece(const Furniture& piece, double height);

  Canvas& canvas_;
  const House& house_;
  cv::Point2d lower_left_;
  double scale_;
};

void HousePainter::outline(const std::vector<cv::Point2d>& points, const cv::Scalar& colour) {
  std::vector<cv::Point2d> closed = points;
  closed.push_back(points.front());
  canvas_.polyline(closed, colour, 0.75);
}

void HousePainter::paint_part(const Pose2& pose, const FurniturePart& part,
                              const cv::Scalar& colour) {
  std::vector<cv::Point2d> points;
  const Point2 m = part.area.middle();
  if (part.is_round) {
    for (int i = 0; i < 24; ++i) {
      const double a = 2.0 * kPi * i / 24.0;
      points.push_back(at(pose * (m + Point2{0.5 * part.area.width() * std::cos(a),
                                             0.5 * part.area.height() * std::sin(a)})));
    }
  } else {
    const Rectangle& r = part.area;
    for (const Point2 p :
         {Point2{r.x0, r.y0}, Point2{r.x1, r.y0}, Point2{r.x1, r.y1}, Point2{r.x0, r.y1}}) {
      points.push_back(at(pose * p));
    }
  }
  canvas_.polygon(points, colour);
  outline(points, kInk);
}

void HousePainter::paint(const Furniture& piece) {
  const Look& look = look_of(piece.name);
  std::vector<FurniturePart> parts = piece.parts;
  std::stable_sort(parts.begin(), parts.end(), [](const FurniturePart& a, const FurniturePart& b) {
    return a.top_m < b.top_m;
  });
  for (const FurniturePart& part : parts) {
    paint_part(piece.T_house_piece, part, look.colour);
  }
  if (piece.name == "bed") {  // pillows
    const int pillows = piece.size_y_m > 1.3 ? 2 : 1;
    const double width = piece.size_y_m / pillows - 0.2;
    for (int i = 0; i < pillows; ++i) {
      const double y = (i + 0.5) * piece.size_y_m / pillows - 0.5 * piece.size_y_m;
      const double x = -0.5 * piece.size_x_m + 0.3;
      paint_part(piece.T_house_piece,
                 {{x - 0.18, y - 0.5 * width, x + 0.18, y + 0.5 * width}, 0.5, 0.6}, kPaper);
    }
  }
  if (piece.name == "stove") {
    for (const double x : {-0.13, 0.13}) {
      for (const double y : {-0.13, 0.13}) {
        canvas_.disc(at(piece.T_house_piece * Point2{x, y}), 0.09 * scale_, kInk);
      }
    }
  }
  if (piece.name == "sink" || piece.name == "basin") {
    paint_part(piece.T_house_piece, {{-0.16, -0.2, 0.16, 0.2}, 0.8, 0.9, piece.name == "basin"},
               kPaper);
  }
  if (piece.name == "bathtub") {
    const double x = 0.5 * piece.size_x_m - 0.08;
    const double y = 0.5 * piece.size_y_m - 0.08;
    paint_part(piece.T_house_piece, {{-x, -y, x, y}, 0.5, 0.55}, kPaper);
  }
  if (piece.name == "shower") {
    const double h = 0.5 * piece.size_x_m;
    canvas_.polyline(
        {at(piece.T_house_piece * Point2{-h, -h}), at(piece.T_house_piece * Point2{h, h})}, kInk,
        0.75);
    canvas_.polyline(
        {at(piece.T_house_piece * Point2{-h, h}), at(piece.T_house_piece * Point2{h, -h})}, kInk,
        0.75);
  }
  if (piece.name == "washing machine") {
    canvas_.disc(at(piece.T_house_piece.position()), 0.2 * scale_, kPaper);
  }
}

void HousePainter::paint(const Opening& opening) {
  const Rectangle& a = opening.area;
  switch (opening.kind) {
    case Opening::Kind::kWindow:
      canvas_.fill(at(a), kPaper);
      canvas_.frame(at(a), kWall, 0.75);
      canvas_.fill(at(a.height() > a.width()
                          ? Rectangle{a.middle().x - 0.03, a.y0, a.middle().x + 0.03, a.y1}
                          : Rectangle{a.x0, a.middle().y - 0.03, a.x1, a.middle().y + 0.03}),
                   kGlass);
      break;
    case Opening::Kind::kEntrance:
      canvas_.fill(at(a), {110, 150, 190});
      canvas_.frame(at(a), kWall, 0.75);
      break;
    case Opening::Kind::kDoor:
      canvas_.fill(at(a), floor_of(RoomPurpose::kHall));
      paint_leaf(opening);
      break;
    case Opening::Kind::kPassage:
      canvas_.fill(at(a), floor_of(RoomPurpose::kHall));
      break;
  }
}

/// The door's leaf at a right angle to the wall, in its room, and the way it swings.
void HousePainter::paint_leaf(const Opening& door) {
  const Rectangle& a = door.area;
  const Rectangle& room = house_.rooms[static_cast<std::size_t>(door.room)].area;
  const bool is_upright = a.height() > a.width();
  const Point2 along = is_upright ? Point2{0.0, 1.0} : Point2{1.0, 0.0};
  const double begin = is_upright ? a.y0 : a.x0;
  const double end = is_upright ? a.y1 : a.x1;
  const double room_begin = is_upright ? room.y0 : room.x0;
  const double room_end = is_upright ? room.y1 : room.x1;
  // Hinged at the side that is nearer to a corner of the room.
  const double sign = begin - room_begin < room_end - end ? 1.0 : -1.0;
  const bool is_before =
      is_upright ? room.middle().x > a.middle().x : room.middle().y > a.middle().y;
  const double face = is_upright ? (is_before ? a.x1 : a.x0) : (is_before ? a.y1 : a.y0);
  const double post = sign > 0.0 ? begin : end;
  const Point2 hinge = is_upright ? Point2{face, post} : Point2{post, face};
  const Point2 into = (is_before ? 1.0 : -1.0) * (is_upright ? Point2{1.0, 0.0} : Point2{0.0, 1.0});
  std::vector<cv::Point2d> arc;
  for (int i = 0; i <= 12; ++i) {
    const double angle = 0.5 * kPi * i / 12.0;
    arc.push_back(at(hinge + (door.width_m() * std::cos(angle)) * into +
                     (sign * door.width_m() * std::sin(angle)) * along));
  }
  canvas_.polyline(arc, kFaint, 0.75);
  canvas_.polyline({at(hinge), at(hinge + door.width_m() * into)}, kInk, 1.0);
}

void HousePainter::name_room(std::size_t room, double most_height) {
  const Room& r = house_.rooms[room];
  const std::string text = name(r.purpose);
  const double fit = (scale_ * r.area.width() - 2.0) / Canvas::text_width(text, most_height);
  const double height = std::min(1.0, fit) * most_height;
  // Where the fewest pieces are in the way.
  const double half_x = 0.5 * Canvas::text_width(text, height) / scale_ + 0.05;
  const double half_y = 0.5 * height / scale_ + 0.05;
  Point2 best = r.area.middle();
  double least = 1e9;
  for (int i = 0; i <= 12; ++i) {
    for (int j = 0; j <= 12; ++j) {
      const Point2 p{r.area.x0 + half_x + (r.area.width() - 2.0 * half_x) * i / 12.0,
                     r.area.y0 + half_y + (r.area.height() - 2.0 * half_y) * j / 12.0};
      const Rectangle box{p.x - half_x, p.y - half_y, p.x + half_x, p.y + half_y};
      double cost = 0.1 * norm(p - r.area.middle());
      for (const Furniture& piece : house_.furniture) {
        const Rectangle f = piece.footprint();
        if (overlap(f, box)) {
          cost += 1.0 + (std::min(f.x1, box.x1) - std::max(f.x0, box.x0)) *
                            (std::min(f.y1, box.y1) - std::max(f.y0, box.y0)) / box.area();
        }
      }
      if (cost < least) {
        least = cost;
        best = p;
      }
    }
  }
  const cv::Point2d c = at(best);
  canvas_.text(text, {c.x, c.y + 0.5 * height}, height, {40, 40, 160}, Align::kMiddle);
}

void HousePainter::name_piece(const Furniture& piece, double height) {
  if (piece.name == "chair" || piece.name == "wall cupboard" || piece.name == "TV") {
    return;
  }
  const Rectangle f = piece.footprint();
  const double width = Canvas::text_width(piece.name, height);
  const double fit = std::min(1.0, (f.width() * scale_ - 4.0) / width);
  if (fit < 0.5) {
    return;
  }
  const cv::Point2d c = at(piece.T_house_piece.position());
  canvas_.text(piece.name, {c.x, c.y + 0.5 * fit * height}, fit * height, kInk, Align::kMiddle);
}

void HousePainter::paint(bool names_furniture) {
  for (const Room& room : house_.rooms) {
    canvas_.fill(at(room.area), floor_of(room.purpose));
  }
  for (const Wall& wall : house_.walls) {
    if (wall.bottom_m == 0.0) {
      canvas_.fill(at(wall.area), kWall);
    }
  }
  for (const Opening& opening : house_.openings) {
    paint(opening);
  }
  std::vector<const Furniture*> pieces;
  for (const Furniture& piece : house_.furniture) {
    if (piece.elevation_m < 1.2) {
      pieces.push_back(&piece);
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Furniture* a, const Furniture* b) {
    return (a->name == "chair") > (b->name == "chair");  // chairs go under tables
  });
  for (const Furniture* piece : pieces) {
    paint(*piece);
  }
  if (names_furniture) {
    for (const Furniture* piece : pieces) {
      name_piece(*piece, 0.09 * scale_);
    }
  }
  for (std::size_t i = 0; i < house_.rooms.size(); ++i) {
    name_room(i, names_furniture ? 0.16 * scale_ : 7.0);
  }
}

}  // namespace

cv::Mat house_picture(const House& house, double pixels_per_metre) {
  constexpr double kMargin = 20.0;
  const cv::Size size{static_cast<int>(house.outline.x1 * pixels_per_metre + 2.0 * kMargin),
                      static_cast<int>(house.outline.y1 * pixels_per_metre + 2.0 * kMargin)};
  Canvas canvas{size, kPaper};
  HousePainter{canvas, house, {kMargin, size.height - kMargin}, pixels_per_metre}.paint(true);
  return canvas.finished();
}

cv::Mat house_sheet(const std::vector<House>& houses, const std::vector<std::string>& titles,
                    double pixels_per_metre, int width_px) {
  constexpr double kGap = 22.0;
  constexpr double kTitle = 20.0;
  constexpr double kLegend = 40.0;
  constexpr double kLetters = 8.0;
  // Row by row, as many as fit.
  std::vector<cv::Rect2d> places;
  double x = kGap;
  double y = kGap;
  double row_height = 0.0;
  for (std::size_t i = 0; i < houses.size(); ++i) {
    const double width =
        std::max(houses[i].outline.x1 * pixels_per_metre, Canvas::text_width(titles[i], kLetters));
    const double height = houses[i].outline.y1 * pixels_per_metre + kTitle;
    if (x > kGap && x + width + kGap > width_px) {
      x = kGap;
      y += row_height + kGap;
      row_height = 0.0;
    }
    places.emplace_back(x, y, width, height);
    x += width + kGap;
    row_height = std::max(row_height, height);
  }
  const cv::Size size{width_px, static_cast<int>(y + row_height + kLegend + kGap)};
  Canvas canvas{size, kPaper};
  for (std::size_t i = 0; i < houses.size(); ++i) {
    const cv::Rect2d& place = places[i];
    const double margin = 0.5 * (place.width - houses[i].outline.x1 * pixels_per_metre);
    canvas.text(titles[i], {place.x + 0.5 * place.width, place.y + 0.6 * kTitle}, kLetters, kInk,
                Align::kMiddle);
    HousePainter{canvas, houses[i], {place.x + margin, place.y + place.height}, pixels_per_metre}
        .paint(false);
  }
  x = kGap;
  for (const Look& look : kLooks) {
    if (look.meaning != nullptr) {
      const cv::Rect2d patch{x, size.height - 30.0, 14.0, 14.0};
      canvas.fill(patch, look.colour);
      canvas.frame(patch, kInk, 0.75);
      canvas.text(look.meaning, {x + 20.0, size.height - 18.0}, 9.0, kInk);
      x += 44.0 + Canvas::text_width(look.meaning, 9.0);
    }
  }
  return canvas.finished();
}

}  // namespace cmn
