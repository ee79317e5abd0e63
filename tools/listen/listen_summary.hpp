// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "host/runtime/latency_histogram.hpp"
#include "tools/listen/received_pose.hpp"

namespace pharos::tools {

/// Errors compared with the truth, as root mean square and largest, and with their covariances, as mean NEES.
struct ErrorSums {
  std::int64_t count = 0;
  double squared_rotation_rad2 = 0.0;
  double squared_position_m2 = 0.0;
  double max_rotation_rad = 0.0;
  double max_position_m = 0.0;
  std::int64_t with_nees = 0;
  double nees = 0.0;

  void add(const PoseError& error);
  double rms_rotation_rad() const;
  double rms_position_m() const;
  double mean_nees() const { return with_nees == 0 ? 0.0 : nees / static_cast<double>(with_nees); }
};

/// Statistics of one station on one target, as one source tells them.
struct SourceSummary {
  std::string channel;
  std::string source;
  std::string target;
  int station = 0;
  std::string camera;  // empty: a station's
  std::int64_t poses = 0;
  std::int64_t refused = 0;
  std::int64_t lost = 0;  // gaps in the sequence numbers, of all stations of the target
  double seconds = 0.0;   // from the first to the last pose
  host::LatencyHistogram age;
  ErrorSums error;
  /// Of poses before the station's calibration was received (the first seconds): a degree and more is normal there.
  ErrorSums uncalibrated_error;

  double rate_hz() const { return poses > 1 && seconds > 0.0 ? static_cast<double>(poses - 1) / seconds : 0.0; }
};

/// Statistics of all received messages.
class ListenSummary {
 public:
  /// Stations, cameras and sources that are kept: far more than an approach has; names are anyone's who reaches LCM.
  static constexpr std::size_t kMaxStreams = 256;

  /// Whether this message's stream is known, or can still be kept.
  bool has_room(const ReceivedPose& pose) const;
  /// Counts one message (all but its error) that has room. Returns the rate of its kind over the last second, 1/s.
  double add(const ReceivedPose& pose, std::int64_t monotonic_ns);
  void add_error(const ReceivedPose& pose, const PoseError& error);

  std::int64_t poses() const { return poses_; }
  std::vector<SourceSummary> sources() const;

 private:
  using Key = std::tuple<std::string, std::string, int, std::string>;  // channel, target, station, source
  struct Stream {
    SourceSummary summary;
    std::int64_t first_utime_us = 0;
    std::deque<std::int64_t> arrivals_ns;
  };

  std::map<Key, Stream> streams_;
  std::map<std::pair<std::string, std::string>, std::int64_t> last_sequence_;  // by channel and source/target
  std::int64_t poses_ = 0;
};

/// As text for the user: a block a source, millimetres and degrees.
std::string summary_text(const std::vector<SourceSummary>& sources);

}  // namespace pharos::tools
