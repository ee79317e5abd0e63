// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// Decoding rate, pulses a second on one core: from memory, and from a gzip file through the table reader. `edges` is a
/// recording (sensor,rise_ticks,fall_ticks); empty: a simulated minute of one station and twelve sensors.
/// Throws host::InputError when it cannot be read.
std::vector<BenchRow> bench_decode(const std::string& edges);

}  // namespace pharos::tools
