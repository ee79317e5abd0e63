// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"
#include "tools/evaluation/bench/edge_drawing.hpp"

namespace pharos::tools {

/// Our ellipse detector compared with OpenCV's EdgeDrawing (null: without peer) on the same rendered docking rings, in
/// one run: recall, F, errors of axes and processor time on plain rings to 60 deg of tilt, on rings to 35 deg, with a
/// third hidden, with three times the noise, and on sheets of dots and of rings of 1024x768 from b = 4 px.
std::vector<BenchRow> bench_ellipses(int images, EdgeDrawingFunction peer);

/// Basis for the choice of T_val: recall, precision and F of our detector over thresholds, each on all those rings.
void write_threshold_sweep(int images, BenchForm form);

}  // namespace pharos::tools
