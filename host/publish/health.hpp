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

/// State of a source of data.
enum class SourceState : std::uint8_t {
  kOk,
  kDegraded,  // data and poses come, but fewer than expected
  kWaiting,   // no data yet
  kStale,     // data stopped
  kGone,      // device unplugged or not there
  kError,     // an error that needs the user
};
const char* name_of(SourceState state);

/// Health of one source, as in source_status_t.
struct SourceHealth {
  std::string source;
  std::string target;
  SourceState state = SourceState::kWaiting;
  std::string message;  // the error and what to do; empty when ok
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
  std::string message;  // error of the daemon itself (recording stopped, …); empty when there is none
  NamedCounts counters;
  std::vector<SourceHealth> sources;
};

}  // namespace pharos::host
