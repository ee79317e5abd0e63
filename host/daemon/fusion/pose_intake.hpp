// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/config/vehicle_config.hpp"
#include "host/mounting/source_table.hpp"
#include "host/publish/health.hpp"

namespace pharos {
class pose_t;
}

namespace pharos::host {

// What became of the poses that the sources published. X(name, what it counts)
#define PHAROS_INTAKE_COUNTERS(X)                                                           \
  X(poses_taken, "poses given to the estimator")                                            \
  X(poses_without_answer, "refusals of a source")                                           \
  X(poses_not_fused, "poses of a source or target without a mounting")                      \
  X(poses_other_frame, "poses whose frames are not those of the mounting's kind of source") \
  X(poses_doubtful, "poses flagged uncalibrated, suspect or clock_set")                     \
  X(poses_other_station, "poses of a lighthouse station that the mounting does not describe")

struct IntakeCounters {
#define PHAROS_X(name, text) std::int64_t name = 0;
  PHAROS_INTAKE_COUNTERS(PHAROS_X)
#undef PHAROS_X
};

/// A published pose as the fusion takes it.
struct TakenPose {
  std::size_t source = 0;  // index of VehicleConfig::sources
  SourceRow row;
};

/// Published poses to rows of the sources of [vehicle]; counts those that are none. Without I/O.
class PoseIntake {
 public:
  explicit PoseIntake(const VehicleConfig& config);

  /// `channel` is the one behind the prefix: poses that a board solved itself (LIGHTHOUSE_BOARD_POSE) are not taken, as
  /// they repeat what the host solves.
  std::optional<TakenPose> take(const std::string& channel, const pose_t& message);

  const IntakeCounters& counters() const { return counters_; }
  /// What a user has to mend; empty when there is nothing. Once not empty it stays, and the source is not taken.
  const std::string& error() const { return error_; }

 private:
  std::optional<std::size_t> source_of(const pose_t& message) const;
  bool is_its_station(std::size_t source, const pose_t& message);

  // The station that was seen first, where the configuration names none.
  struct SeenStation {
    bool any = false;
    bool several = false;
    int slot = 0;
    std::string id;
  };

  std::string target_;
  std::vector<FusedSourceConfig> sources_;
  std::vector<SeenStation> stations_;
  IntakeCounters counters_;
  std::string error_;
};

/// Flagged uncalibrated, suspect or clock_set: not to be fused.
bool is_doubtful(const pose_t& message);

NamedCounts named_counts(const IntakeCounters& counters);

}  // namespace pharos::host
