// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Paper 000's tables 2 and 3 on simulated frames: its four tests at its measured means, each `frames` long.
///
/// Table 2: means and standard deviations of single frames. Table 3: what the means of two tests differ by, less the
/// truth. Theirs: the paper's chain on 8-bit depth (tools/tof/paper), and OpenCV's ORB from frame to frame. With
/// `folder` also the stages of figures 5 and 6 and the series of figures 9 and 10 are written there.
struct FourTestsOptions {
  int frames = 100;
  std::uint64_t seed = 1;
  bool printed_threshold = true;  ///< (5) as printed; false: with the number of pixels
};
report::PartResult reproduce_four_tests(const FourTestsOptions& options, const std::filesystem::path& folder = {});

}  // namespace pharos::tools
