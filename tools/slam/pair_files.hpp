// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "host/device/pair_names.hpp"
#include "tools/slam/slam_files.hpp"

namespace pharos::tools {

/// Which pairs of two folders.
struct PairChoice {
  std::string left, right;  // folders
  double rate_hz = 20.0;    // where names contain no time
  std::size_t pairs = 0;    // the first ones, or forwards and backwards repeatedly; 0: all
};

/// The selected pairs, in order. Images without a partner are reported, counted and left out; numbers that are missing
/// among names without times are reported. Throws InputError as host::pair_names does, NoPairError
/// where both folders are the same.
std::vector<host::PairName> wanted_pairs(const PairChoice& choice, RunFigures& figures);

struct PairImages {
  host::GreyImage left, right;
};

/// Throws InputError for a pair that cannot be read.
PairImages read_pair(const host::PairName& pair);

/// Throws InputError for other sizes than the rig's.
void require_size(const host::PairName& pair, const PairImages& images, const host::RigFile& rig);

/// Throws NoPairError where both images are the same picture of something: the left camera's twice.
void require_two_views(const host::PairName& pair, const PairImages& images);

}  // namespace pharos::tools
