// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"
#include "tools/evaluation/bench/edge_drawing.hpp"

namespace pharos::tools {

/// Processor time of a depth camera's frame, stage by stage, on simulated satellites (rings of 1.1 and 0.6 m at random
/// poses, whole and with a third hidden, a quarter of the frames each); the ellipse stages are compared with OpenCV's
/// EdgeDrawing (null: without peer) on the same images at 8 bits, in one run.
std::vector<BenchRow> bench_tof(int frames, EdgeDrawingFunction peer);

}  // namespace pharos::tools
