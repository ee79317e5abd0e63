// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

struct EnhanceBench {
  /// Folder of aloeL.jpg, building.jpg and graf1.png (Debian's opencv-doc).
  std::string images = "/usr/share/doc/opencv-doc/examples/data";
  int pairs = 20;  // of dark views of a satellite
};

/// The low-light enhancement at 640x480 compared with its peers, all in one run: the illumination with an exact sparse
/// solution; BM3D and the fast denoiser with OpenCV's non-local means at its best strength, Gaussian noise of sigma 15;
/// features that match between two dark views with those of plain images, CLAHE and a multi-scale retinex. Times are of
/// one thread's processor. Throws host::InputError where the images are missing.
std::vector<BenchRow> bench_enhance(const EnhanceBench& options);

}  // namespace pharos::tools
