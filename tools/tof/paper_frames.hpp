// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/support/output.hpp"

namespace pharos::tools {

/// `pharos tof --method paper`.
struct PaperFramesOptions {
  std::string folder, camera;
  std::string stages = {};        ///< folder for pictures of the steps; empty: none
  bool printed_threshold = true;  ///< (5) as printed
  bool summary = false;
  OutputOptions output = {};
};

/// Every frame of the folder by paper 000's chain (paper/), in the columns of `pharos tof`; what the paper does not
/// state is empty. Returns the command's exit code.
int run_paper_frames(const PaperFramesOptions& options);

}  // namespace pharos::tools
