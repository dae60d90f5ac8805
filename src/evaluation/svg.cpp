// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/svg.hpp"

#include <array>
#include <cstdio>

namespace cmn {
namespace {

/// A coordinate with two decimals at most.
std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  std::string result = text.data();
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') {
    result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string{" "} + name + "=\"" + value + "\"";
}
std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string attributes_of(const Stroke& stroke) {
  return attribute("fill", "none") + attribute("stroke", stroke.colour) +
         attribute("stroke-width", stroke.width) +
         (stroke.dash.empty() ? "" : attribute("stroke-dasharray", stroke.dash));
}

}  // namespace

Svg::Svg(double width, double height) : width_{width}, height_{height} {}

void Svg::line(cv::Point2d from, cv::Point2d to, const Stroke& stroke) {
  body_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
           attribute("y2", to.y) + attributes_of(stroke) + "/>\n";
}

void Svg::polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke) {
  std::string list;
  for (const cv::Point2d p : points) {
    list += (list.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
  }
  body_ += "<polyline" + attribute("points", list) + attributes_of(stroke) +
           attribute("stroke-linejoin", "round") + "/>\n";
}

void Svg::fill(const cv::Rect2d& area, const std::string& colour, double opacity) {
  body_ += "<rect" + attribute("x", area.x) + attribute("y", area.y) +
           attribute("width", area.width) + attribute("height", area.height) +
           attribute("fill", colour) + (opacity < 1.0 ? attribute("fill-opacity", opacity) : "") +
           "/>\n";
}

void Svg::disc(cv::Point2d center, double radius, const std::string& colour) {
  body_ += "<circle" + attribute("cx", center.x) + attribute("cy", center.y) +
           attribute("r", radius) + attribute("fill", colour) + "/>\n";
}

void Svg::text(const std::string& text, cv::Point2d at, double size, const std::string& colour,
               Align align, bool bold, double turned_deg) {
  constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
  body_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + attribute("font-size", size) +
           attribute("fill", colour) +
           attribute("text-anchor", kAnchors[static_cast<std::size_t>(align)]) +
           (bold ? attribute("font-weight", "bold") : "") +
           (turned_deg != 0.0 ? attribute("transform", "rotate(" + number(turned_deg) + " " +
                                                           number(at.x) + " " + number(at.y) + ")")
                              : "") +
           ">" + escaped(text) + "</text>\n";
}

double Svg::text_width(const std::string& text, double size) {
  return 0.6 * size * static_cast<double>(text.size());
}

std::string Svg::finished() const {
  const std::string width = number(width_);
  const std::string height = number(height_);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
         attribute("height", height) + attribute("viewBox", "0 0 " + width + " " + height) +
         " font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + body_ + "</svg>\n";
}

}  // namespace cmn
