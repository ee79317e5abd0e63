// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pharos::host {

/// One counter by name.
struct NamedCount {
  std::string name;
  std::int64_t value = 0;
};
using NamedCounts = std::vector<NamedCount>;

/// How a source of data fares.
enum class SourceState : std::uint8_t {
  kOk,
  kWaiting,  // no data yet
  kStale,    // data stopped
  kGone,     // device unplugged or not there
  kError,    // something that does not mend itself
};
const char* name_of(SourceState state);

/// Health of one target's line, as in source_status_t.
struct SourceHealth {
  std::string source;
  std::string target;
  SourceState state = SourceState::kWaiting;
  std::string message;  // what is wrong and what to do; empty when ok
  std::string device;
  std::string identity;
  std::int64_t data_age_ns = -1;  // -1: never
  std::int64_t pose_age_ns = -1;
  double pose_rate_hz = 0.0;
  double clock_sigma_ns = 0.0;
  double clock_drift_ppm = 0.0;
  NamedCounts counters;
};

/// Health of the daemon, as in status_t. Its state is that of its sources: ok when all are, error when all are in
/// error, degraded between.
struct DaemonHealth {
  std::int64_t utc_ns = 0;
  std::int64_t uptime_ns = 0;
  std::string host;
  std::string version;
  std::string message;  // of the daemon itself (recording stopped, …); empty when nothing is wrong
  NamedCounts counters;
  std::vector<SourceHealth> sources;
};

}  // namespace pharos::host
