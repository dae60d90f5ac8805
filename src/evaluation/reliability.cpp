// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/reliability.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/evaluation/plot_panel.hpp"
#include "coarse_map_nav/evaluation/svg.hpp"
#include "coarse_map_nav/evaluation/table_text.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <utility>

namespace cmn {
namespace {

constexpr int kResamples = 1000;
constexpr std::size_t kBins = ConfidenceBins::kCount;

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

double calibration_error(const ConfidenceBins& all) {
  double off = 0.0;
  for (const ConfidenceBins::Bin& bin : all.bins()) {
    off += std::abs(bin.stated - bin.right);
  }
  return share(off, all.looks());
}

/// `value` with the 2.5 and 97.5 % quantiles of its resamples, those that are no numbers left out.
Figure with_quantiles(double value, std::vector<double> resampled) {
  resampled.erase(
      std::remove_if(resampled.begin(), resampled.end(), [](double v) { return std::isnan(v); }),
      resampled.end());
  if (resampled.empty()) {
    return {};
  }
  std::sort(resampled.begin(), resampled.end());
  const auto at = [&](double quantile) {
    return resampled[static_cast<std::size_t>(quantile * static_cast<double>(resampled.size() - 1) +
                                              0.5)];
  };
  return {value, at(0.025), at(0.975)};
}

/// "0.95-0.99".
std::string range_text(std::size_t bin) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g-%g", ConfidenceBins::kEdges[bin],
                ConfidenceBins::kEdges[bin + 1]);
  return text.data();
}

void draw_method(Svg& svg, const PlotPanel& panel, const Reliability& reliability,
                 const Stroke& stroke) {
  constexpr double kLargestDot = 9.0;
  std::vector<cv::Point2d> line;
  for (const ReliabilityBin& bin : reliability.bins) {
    if (bin.looks > 0) {
      line.push_back(panel.at(100.0 * bin.stated, bin.right.value));
    }
  }
  svg.polyline(line, {stroke.colour, 1.2, stroke.dash});
  for (const ReliabilityBin& bin : reliability.bins) {
    if (bin.looks == 0) {
      continue;
    }
    const double x = 100.0 * bin.stated;
    svg.line(panel.at(x, bin.right.low), panel.at(x, bin.right.high), {stroke.colour, 1.0, ""});
    const double part = static_cast<double>(bin.looks) / reliability.looks;
    svg.disc(panel.at(x, bin.right.value), std::max(1.6, kLargestDot * std::sqrt(part)),
             stroke.colour);
  }
}

}  // namespace

Reliability reliability_of(const std::vector<EpisodeRow>& rows) {
  std::vector<const EpisodeRow*> episodes;
  ConfidenceBins all;
  for (const EpisodeRow& row : rows) {
    if (row.confidence.looks() > 0) {
      episodes.push_back(&row);
      all.add(row.confidence);
    }
  }
  std::sort(episodes.begin(), episodes.end(),
            [](const EpisodeRow* a, const EpisodeRow* b) { return a->key < b->key; });
  std::mt19937_64 rng{1};
  std::array<std::vector<double>, kBins> shares;
  std::vector<double> errors;
  for (int i = 0; i < kResamples && !episodes.empty(); ++i) {
    ConfidenceBins resample;
    for (std::size_t j = 0; j < episodes.size(); ++j) {
      resample.add(episodes[draw_index(rng, episodes.size())]->confidence);
    }
    errors.push_back(calibration_error(resample));
    for (std::size_t b = 0; b < kBins; ++b) {
      shares[b].push_back(share(resample.bins()[b].right, resample.bins()[b].looks));
    }
  }
  Reliability reliability;
  reliability.looks = all.looks();
  reliability.calibration_error = with_quantiles(calibration_error(all), std::move(errors));
  for (std::size_t b = 0; b < kBins; ++b) {
    const ConfidenceBins::Bin& bin = all.bins()[b];
    reliability.bins[b] = {bin.looks, share(bin.stated, bin.looks),
                           with_quantiles(share(bin.right, bin.looks), std::move(shares[b]))};
  }
  return reliability;
}

std::string reliability_table(const EpisodeTable& table) {
  std::vector<std::string> head{"confidence"};
  std::vector<Reliability> all;
  for (const std::string& method : methods_of(table.rows)) {
    const Reliability reliability = reliability_of(of_method(table.rows, method));
    if (reliability.looks > 0) {
      head.push_back(method_label(method) + ": looks");
      head.emplace_back("stated [%]");
      head.emplace_back("right [%]");
      all.push_back(reliability);
    }
  }
  if (all.empty()) {
    return "";
  }
  std::string text = table_head(head);
  for (std::size_t b = 0; b < kBins; ++b) {
    std::vector<std::string> cells{range_text(b)};
    for (const Reliability& reliability : all) {
      const ReliabilityBin& bin = reliability.bins[b];
      cells.push_back(std::to_string(bin.looks));
      cells.push_back(percent_text(bin.stated));
      cells.push_back(interval_text(bin.right));
    }
    text += table_row(cells);
  }
  std::vector<std::string> cells{"calibration error [%]"};
  for (const Reliability& reliability : all) {
    cells.push_back(std::to_string(reliability.looks));
    cells.emplace_back("");
    cells.push_back(interval_text(reliability.calibration_error));
  }
  return text + table_row(cells) + "\n";
}

std::string reliability_plot(const std::vector<EpisodeTable>& tables) {
  assert(!tables.empty());
  const std::vector<std::string> known = methods_in(tables);
  std::vector<std::string> methods;
  std::vector<std::vector<Reliability>> of_table(tables.size());
  for (const std::string& method : known) {
    bool has_looks = false;
    std::vector<Reliability> found;
    for (const EpisodeTable& table : tables) {
      found.push_back(reliability_of(of_method(table.rows, method)));
      has_looks = has_looks || found.back().looks > 0;
    }
    if (has_looks) {
      methods.push_back(method);
      for (std::size_t t = 0; t < tables.size(); ++t) {
        of_table[t].push_back(found[t]);
      }
    }
  }
  if (methods.empty()) {
    return "";
  }
  constexpr double kSide = 240.0;
  const double width =
      kPlotLeft + (kSide + kPlotGap) * static_cast<double>(tables.size()) - kPlotGap + kPlotRight;
  const double legend_top = kPlotTop + kSide + 44.0;
  const double inner = width - kPlotLeft - kPlotRight;
  const double legend = legend_height(inner, methods);
  Svg svg{width, legend_top + legend + 26.0};
  draw_plot_title(svg, "Reliability of the stated confidence", tables.front().task, width);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const double left = kPlotLeft + (kSide + kPlotGap) * static_cast<double>(t);
    const PlotPanel panel{{left, kPlotTop, kSide, kSide}, 100.0, 1.0};
    panel.draw_percent_rules(svg, t == 0);
    panel.draw_count_axis(svg, "stated confidence [%]");
    panel.draw_title(svg, tables[t]);
    if (t == 0) {
      panel.draw_value_name(svg, "looks that were right [%]");
    }
    svg.line(panel.at(0.0, 0.0), panel.at(100.0, 1.0), {kPlotGrey, 1.0, "4 3"});
    for (std::size_t i = methods.size(); i-- > 0;) {
      draw_method(svg, panel, of_table[t][i], method_stroke(methods[i], known));
    }
    panel.draw_axes(svg);
  }
  draw_legend(svg, {kPlotLeft, legend_top}, inner, methods);
  svg.text("dashed: as stated; area of a dot: share of the looks",
           {kPlotLeft, legend_top + legend + 13.0}, 10.0, kPlotGrey);
  return svg.finished();
}

}  // namespace cmn
