// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace pharos::host {

/// One trial: what was done, what came of it.
struct CampaignRow {
  std::string test;
  std::string load;
  std::int64_t false_answers = 0;         // answers that count as `ok` and are wrong
  std::optional<std::int64_t> lost = {};  // poses lost, or uncounted; none: the trial has no poses to lose
  std::string memory;                     // maximum resident memory
};

/// Prints a row at once; the whole table follows at the program's end.
void add_row(const CampaignRow& row);

/// "pharosd 29 MiB": the most that a running process had resident (VmHWM).
std::string peak_memory(const std::string& name, pid_t process);
std::string memory_text(const std::string& name, double mib);
/// "1.24 s"
std::string seconds_text(double seconds);

/// The size of a trial: the environment variable's number, or `usual`.
std::int64_t campaign_size(const char* variable, std::int64_t usual);

}  // namespace pharos::host
