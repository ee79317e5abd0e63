// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/support/output.hpp"

namespace pharos::tools {

/// Files of `pharos track --sweeps`.
struct NetworkFiles {
  std::string sweeps, stream;  // one of both: a table, or a recorded serial stream of a target of Lighthouse 2.0
  std::string stations, target;
  bool stats = false;
};

/// Sweeps of several stations of known poses to T_world_body, a row a sweep; the exit code. A stream gives the poses
/// that `pharosd` publishes of it.
int track_network(const NetworkFiles& files, const OutputOptions& output);

}  // namespace pharos::tools
