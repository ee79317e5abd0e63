// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::host {

/// Processor time and memory of this process.
struct ProcessUsage {
  std::int64_t cpu_us = 0;             // user and system time since start
  std::int64_t resident_kib = 0;       // memory in use now
  std::int64_t peak_resident_kib = 0;  // maximum so far
};

ProcessUsage process_usage();

}  // namespace pharos::host
