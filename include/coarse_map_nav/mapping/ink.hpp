// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The pixels of a picture that are ink. All pictures CV_8UC1; masks hold 255 = yes, 0 = no.
#pragma once

#include <opencv2/core.hpp>

namespace cmn {

/// Whether almost all pixels are nearly black or nearly white: a drawing made on a computer, or a
/// scan that somebody has thresholded, in contrast to a photo.
bool is_binary(const cv::Mat& gray);

/// The same picture as if the paper were lit evenly: paper 255, ink in proportion. The light is
/// that of the brightest pixels around, spread over what they do not cover.
cv::Mat flatten_light(const cv::Mat& gray);

/// The sheet of paper: the convex hull of the largest bright patch.
cv::Mat find_sheet(const cv::Mat& flat);

/// Pixels darker than a share in (0, 1) of white; Otsu's threshold when it is 0.
cv::Mat threshold_ink(const cv::Mat& flat, double share);

/// Without the patches whose longer side is below a size [px]: dots, letters, punch holes.
cv::Mat remove_specks(const cv::Mat& ink, double size_px);

/// Fills the paper that shows through hatching: enclosed patches that no disc of that diameter [px]
/// fits into.
cv::Mat fill_hatching(const cv::Mat& ink, double diameter_px);

/// Whether the drawing lies within a margin of paper: ink takes up less than a tenth of the rim of
/// the picture. A map that fills its picture has none, and nothing may be cut off it.
bool has_margin(const cv::Mat& ink);

/// The bounding box of the drawing: of the largest patch of ink, strokes up to `gap_px` apart being
/// one; the whole picture when that has no margin; empty when there is no ink.
cv::Rect find_drawing(const cv::Mat& ink, double gap_px);

/// The paper around a drawing, as far as a disc of that diameter [px] comes from the rim of the
/// picture without crossing ink, and small notches beside it; a door in the outer wall does not let
/// it in. None (all 0) when the
/// drawing has no margin, or no outer walls, i.e. when the disc gets almost everywhere.
cv::Mat find_outside(const cv::Mat& ink, double diameter_px);

}  // namespace cmn
