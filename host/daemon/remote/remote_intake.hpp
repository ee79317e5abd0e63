// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/config/remote_config.hpp"
#include "host/daemon/remote/message_series.hpp"
#include "host/daemon/remote/peer_clock.hpp"
#include "host/publish/health.hpp"
#include "host/runtime/clock.hpp"

namespace pharos {
class pose_t;
}

namespace pharos::host {

// What becomes of the messages of one [[remote]]. X(name, what it counts)
#define PHAROS_REMOTE_COUNTERS(X)                                                      \
  X(poses_taken, "poses given to the fusion")                                          \
  X(messages_damaged, "bytes that are no pose_t, or lengths in it that lie")           \
  X(poses_other, "of another source or target on the same channel")                    \
  X(poses_foreign, "of this source in other frames than configured")                   \
  X(poses_repeated, "the same message once more")                                      \
  X(poses_unproven, "of a publisher that is not known yet: after a restart, or wrong") \
  X(poses_doubled, "while two publishers send under one name")                         \
  X(poses_without_answer, "refusals of the source")                                    \
  X(poses_doubtful, "flagged uncalibrated, suspect or clock_set")                      \
  X(poses_not_finite, "values that no pharosd sends: no number, no rotation, no time") \
  X(poses_covariance, "a covariance that is not positive definite")                    \
  X(poses_no_clock, "while the other daemon's clock is not known")                     \
  X(poses_late, "older than max_age_s")                                                \
  X(poses_ahead, "measured in the future")                                             \
  X(poses_back, "not later than the last one")

enum class RemoteOutcome : std::uint8_t {
#define PHAROS_X(name, text) name,
  PHAROS_REMOTE_COUNTERS(PHAROS_X)
#undef PHAROS_X
      kCount
};

/// Name of the counter.
const char* word_of(RemoteOutcome outcome);

/// Messages of another daemon to poses as one of this computer's sources would report them; counts those that are none.
/// Any bytes may come. Without I/O.
class RemoteIntake {
 public:
  explicit RemoteIntake(const RemoteConfig& config) : config_(config) {}

  /// The pose with `source` remote/NAME, and `utime` and its sigma on this computer's clock. `peer`: of the other
  /// daemon; null where both clocks are held together elsewhere.
  std::optional<pose_t> take(std::span<const std::uint8_t> message, const PeerClock* peer, const Clock& clock);

  RemoteOutcome last() const { return last_; }
  std::int64_t count(RemoteOutcome outcome) const { return counts_[static_cast<std::size_t>(outcome)]; }
  /// What the newest message was that is not as configured, for people.
  const std::string& foreign() const { return foreign_; }
  /// Status of the newest refusal of the source.
  const std::string& refusal() const { return refusal_; }
  const MessageSeries& series() const { return series_; }
  NamedCounts counts() const;

 private:
  RemoteOutcome judge(pose_t& message, std::span<const std::uint8_t> bytes, const PeerClock* peer, const Clock& clock);
  std::optional<RemoteOutcome> other_than_ours(const pose_t& message);
  RemoteOutcome put_on_own_clock(pose_t& message, const PeerClock* peer, std::int64_t now_ns, std::int64_t utc_ns);

  RemoteConfig config_;
  MessageSeries series_;
  std::array<std::int64_t, static_cast<std::size_t>(RemoteOutcome::kCount)> counts_{};
  RemoteOutcome last_ = RemoteOutcome::kCount;
  std::array<std::int64_t, 2> last_utime_us_{};  // by station
  std::string foreign_, refusal_;
};

}  // namespace pharos::host
