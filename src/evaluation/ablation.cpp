// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/ablation.hpp"

#include "coarse_map_nav/evaluation/metrics.hpp"
#include "coarse_map_nav/evaluation/plot_panel.hpp"
#include "coarse_map_nav/evaluation/svg.hpp"
#include "coarse_map_nav/evaluation/table_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>

namespace cmn {
namespace {

using Rows = std::vector<EpisodeRow>;

/// The variants among some rows whose base is there, in the order of the methods.
std::vector<std::string> variants_in(const Rows& rows) {
  const std::vector<std::string> methods = methods_of(rows);
  std::vector<std::string> variants;
  for (const std::string& method : methods) {
    const std::string base = base_method(method);
    if (base != method && std::find(methods.begin(), methods.end(), base) != methods.end()) {
      variants.push_back(method);
    }
  }
  return variants;
}

std::string p_text(double p_value) {
  return p_value < 1e-4 ? "< 0.0001" : number_text("%.4f", p_value);
}

}  // namespace

Variants read_variants(const std::string& path) {
  Variants variants;
  std::string faults;
  for (const auto& [name, value] : read_param_file(path)) {
    const std::size_t slash = name.find('/');
    const std::string variant = name.substr(0, slash);
    if (slash == std::string::npos) {
      faults += "\n  " + name + " is no group of parameters";
    } else if (variant == "all" || variant.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                             "0123456789_") != std::string::npos) {
      faults += "\n  " + variant + " is no name: lower case, digits and _, and not \"all\"";
    } else {
      variants[variant][name.substr(slash + 1)] = value;
    }
  }
  if (!faults.empty()) {
    throw std::runtime_error(path + ":" + faults);
  }
  return variants;
}

std::string ablation_table(const EpisodeTable& table) {
  const std::vector<std::string> variants = variants_in(table.rows);
  if (variants.empty()) {
    return "";
  }
  std::string text = table_head({"variant", "N", "SR [%]", "SPL [%]", "declared SR [%]",
                                 "declared elsewhere [%]", "falsely converged [%]",
                                 "SR against the whole", "SPL against the whole", "sign test p"});
  std::string last_base;
  for (const std::string& variant : variants) {
    const std::string base = base_method(variant);
    const Rows whole = of_method(table.rows, base);
    const auto cells_of = [](const std::string& name, const Rows& rows) {
      const Metrics m = metrics_of(rows);
      return std::vector<std::string>{name,
                                      std::to_string(m.episodes),
                                      percent_text(m.success.value),
                                      percent_text(m.spl.value),
                                      percent_text(m.declared_right.value),
                                      percent_text(m.declared_wrong.value),
                                      percent_text(m.falsely_converged.value)};
    };
    if (base != last_base) {
      std::vector<std::string> cells = cells_of("**" + method_label(base) + "**", whole);
      cells.resize(10);
      text += table_row(cells);
      last_base = base;
    }
    const Rows rows = of_method(table.rows, variant);
    const PairedSuccess pairs = paired_success(rows, whole);
    std::vector<std::string> cells = cells_of(method_label(variant), rows);
    cells.push_back(difference_text(pairs.difference));
    cells.push_back(difference_text(pairs.spl_difference));
    cells.push_back(p_text(pairs.p_value));
    text += table_row(cells);
  }
  return text + "\n";
}

std::string ablation_plot(const std::vector<EpisodeTable>& tables) {
  Rows rows;
  for (const EpisodeTable& table : tables) {
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  }
  const std::vector<std::string> variants = variants_in(rows);
  if (variants.empty()) {
    return "";
  }
  constexpr double kWidth = 230.0;
  constexpr double kBand = 20.0;
  constexpr double kBetween = 46.0;
  double names = 60.0;
  for (const std::string& variant : variants) {
    names = std::max(names, Svg::text_width(method_label(variant), kPlotFont) + 14.0);
  }
  const double height = kBand * static_cast<double>(variants.size());
  const double panel_height = kPlotTop + height + 52.0;
  const double width = names + 2.0 * kWidth + kBetween + 2.0 * kPlotRight;
  Svg svg{width, panel_height * static_cast<double>(tables.size())};
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const double top = panel_height * static_cast<double>(t) + kPlotTop;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const double y = top + kBand * static_cast<double>(i);
      if (i % 2 == 0) {
        svg.fill({0.0, y, width, kBand}, "#f4f5f7");
      }
      svg.text(method_label(variants[i]), {names - 8.0, y + kBand / 2.0 + 4.0}, kPlotFont, kPlotInk,
               Align::kRight);
    }
    std::array<char, 96> title{};
    std::snprintf(title.data(), title.size(), "One part off, against the whole: %s, %.2f m/cell",
                  tables[t].task.c_str(), tables[t].mpp);
    svg.text(title.data(), {kPlotLeft, top - 36.0}, 13.0, kPlotInk, Align::kLeft, true);
    std::vector<PairedSuccess> pairs;
    double most = 0.1;  // shown to either side, as a share
    for (const std::string& variant : variants) {
      pairs.push_back(paired_success(of_method(tables[t].rows, variant),
                                     of_method(tables[t].rows, base_method(variant))));
      for (const Figure& figure : {pairs.back().difference, pairs.back().spl_difference}) {
        for (const double value : {figure.low, figure.high}) {
          most = std::isnan(value) ? most : std::max(most, std::abs(value));
        }
      }
    }
    most = 0.1 * std::ceil(10.0 * most - 1e-9);
    for (const bool is_spl : {false, true}) {
      const double left = names + (is_spl ? kWidth + kBetween : 0.0);
      const PlotPanel panel{{left, top, kWidth, height}, 2.0 * most, 1.0};
      for (const double at : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const cv::Point2d foot = panel.at((1.0 + at) * most, 0.0);
        svg.line({foot.x, top}, foot, {at == 0.0 ? "#4a525c" : "#e3e6ea", 1.0, ""});
        svg.text(number_text("%+g", 100.0 * at * most), {foot.x, foot.y + 14.0}, 10.0, kPlotGrey,
                 Align::kMiddle);
      }
      svg.text(is_spl ? "SPL [points]" : "SR [points]", {left + kWidth / 2.0, top + height + 30.0},
               kPlotFont, kPlotGrey, Align::kMiddle);
      for (std::size_t i = 0; i < variants.size(); ++i) {
        const Figure& figure = is_spl ? pairs[i].spl_difference : pairs[i].difference;
        if (!std::isnan(figure.value)) {
          const double y = top + kBand * (static_cast<double>(i) + 0.5);
          const auto x_of = [&](double value) { return panel.at(most + value, 0.0).x; };
          draw_interval(svg, {x_of(figure.value), y}, {x_of(figure.low), y}, {x_of(figure.high), y},
                        "#0072b2");
        }
      }
    }
  }
  return svg.finished();
}

}  // namespace cmn
