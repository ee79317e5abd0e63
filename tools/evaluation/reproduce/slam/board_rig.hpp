// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

struct BoardRig {
  host::RigFile rig;                ///< the left camera is its origin
  std::vector<ComparisonRow> rows;  ///< of "section 3": what the calibration is off by
};

/// A rig calibrated as paper 004, section 3: from 15 pairs of a rendered chessboard in different poses before the rig
/// `truth`, whose cameras look in one direction. Throws host::InputError where they give no rig.
BoardRig rig_from_boards(const host::RigFile& truth, std::uint64_t seed);

}  // namespace pharos::tools
