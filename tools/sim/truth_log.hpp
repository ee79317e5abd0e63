// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>

#include "pharos/geometry/pose.hpp"

namespace pharos::sim {

/// True poses at a time since the start, for all stations.
struct PlayTruth {
  std::function<LighthouseFromBody(std::size_t station, double time_s)> at;
  std::size_t stations = 0;
  double end_s = 0.0;
  std::filesystem::path file;
};

/// Writes true poses during a playback: `utime,station,qw,…,tz_m`, utime in microseconds UTC, one row per 5 ms.
class TruthLog {
 public:
  /// Throws host::InputError when the file cannot be written.
  explicit TruthLog(PlayTruth truth);
  /// Start of the playback, UTC, and its speed as a factor of real time.
  void start(std::int64_t utc_us, double speed);
  /// The playback has reached `time_s`.
  void write_until(double time_s);

 private:
  PlayTruth truth_;
  std::ofstream file_;
  std::int64_t row_ = 0;
  std::int64_t start_utc_us_ = 0;
  double speed_ = 1.0;
};

}  // namespace pharos::sim
