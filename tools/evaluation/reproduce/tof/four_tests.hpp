// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Paper 000's tables 2 and 3 on simulated frames: its four tests at its measured means, each `frames` long.
///
/// Table 2: standard deviations of single frames, by our path, by our path on 8-bit depth, and by the paper's way on
/// 8-bit depth (paper_pose). Table 3: what the means of two tests differ by, less the truth: ours, and OpenCV's ORB
/// from frame to frame, where its module was built.
struct FourTestsOptions {
  int frames = 100;
  std::uint64_t seed = 1;
};
std::vector<ComparisonRow> reproduce_four_tests(const FourTestsOptions& options);

}  // namespace pharos::tools
