// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// One figure of the soft core, with its limit and the figure of the host.
struct TargetRow {
  std::string what;
  double target = 0.0;
  std::optional<double> limit;
  std::string unit;
  std::optional<double> host;
  std::string host_unit;
};

struct TargetBench {
  std::string edges;   // recording for the decoder's counts; empty: simulated light of twelve sensors
  std::string images;  // folder of the images; empty: beside the program
  int problems = 200;
};

/// Instructions on the soft core (RV32IM under QEMU, every run the same), memory of the images, and load of a 50 MHz
/// core at twelve sensors and two stations. Throws host::InputError when QEMU or the images are missing.
std::vector<TargetRow> bench_target(const TargetBench& options);
/// The same figures from 4 to 32 sensors, one row a number of sensors and figure.
std::vector<TargetRow> bench_target_by_sensors(const TargetBench& options);

/// `what,target,limit,unit,host,host_unit` on standard output.
void write_target_rows(const std::vector<TargetRow>& rows, BenchForm form);

}  // namespace pharos::tools
