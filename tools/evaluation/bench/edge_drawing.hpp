// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::tools {

/// OpenCV's EdgeDrawing on an 8-bit grey image without gaps. Fills cx, cy, a, b, theta (px, rad; a >= b) of up to
/// `most` ellipses one after another and the processor time of detection; returns their number, -1 on an error.
using EdgeDrawingFunction = int (*)(const std::uint8_t* pixels, int width_px, int height_px, double* ellipses,
                                    int maximum, double* seconds);

/// From the module beside this program (why: CMakeLists.txt); null, with a message on standard error, where it is
/// missing.
EdgeDrawingFunction load_edge_drawing();

inline constexpr const char* kEdgeDrawingModule = "libpharos_bench_edge_drawing.so";
inline constexpr const char* kEdgeDrawingName = "pharos_bench_edge_drawing";

}  // namespace pharos::tools
