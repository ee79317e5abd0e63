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
  double rate_hz = 20.0;    // where names tell no time
  std::size_t pairs = 0;    // the first ones, or there and back again; 0: all
};

/// The pairs that are wanted, in their order. Images without a partner are told, counted and left out; numbers that are
/// missing among names without times are told. Throws InputError as host::pair_names does.
std::vector<host::PairName> wanted_pairs(const PairChoice& choice, RunFigures& figures);

struct PairImages {
  host::GreyImage left, right;
};

/// Throws InputError for what cannot be read.
PairImages read_pair(const host::PairName& pair);

/// Throws InputError for other sizes than the rig's.
void require_size(const host::PairName& pair, const PairImages& images, const host::RigFile& rig);

}  // namespace pharos::tools
