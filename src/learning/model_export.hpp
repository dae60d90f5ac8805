// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A trained network -> a file of TorchScript.
#pragma once

#include <string>

#include "networks.hpp"

namespace cmn {

/// Writes a copy of `net`, which is a `network` of make_network(), as torch_predictor.hpp describes
/// it. Normalisation is folded into the convolutions. C++ modules cannot be scripted: the graph is
/// recorded while the network looks at one panorama, so the file takes one at a time.
/// `is_half`: weights are stored in 16 bits. The file is there as a whole or not at all.
void export_model(const PredictorNet& net, const std::string& network, const std::string& path,
                  bool is_half);

}  // namespace cmn
