// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/remote/remote_intake.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/daemon/fusion/pose_intake.hpp"
#include "host/publish/words.hpp"
#include "host/receive/message_shape.hpp"
#include "host/receive/message_values.hpp"
#include "host/support/printable.hpp"
#include "host/support/time_units.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/pose_t.hpp"

namespace pharos::host {
namespace {

// A pose may seem to be measured in the future by so many sigmas of the clocks' relation, and by this.
constexpr std::int64_t kAheadSigmas = 5;
constexpr std::int64_t kAhead_ns = 1'000'000;
constexpr double kMaxAsymmetry = 1e-9;  // of a covariance, relative; as fusion::check_measurement
constexpr std::size_t kMaxText = 64;    // of a foreign message, that is told

bool is_positive(const double (&values)[36]) {
  Matrix6 covariance;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) covariance(i, j) = values[6 * i + j];
  }
  if (!covariance.allFinite() || !(covariance.diagonal().array() > 0.0).all()) return false;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double scale = std::sqrt(covariance(i, i)) * std::sqrt(covariance(j, j));
      if (std::abs(covariance(i, j) - covariance(j, i)) > kMaxAsymmetry * scale) return false;
    }
  }
  return covariance.llt().info() == Eigen::Success;
}

}  // namespace

const char* word_of(RemoteOutcome outcome) {
  switch (outcome) {
#define PHAROS_X(name, text) \
  case RemoteOutcome::name:  \
    return #name;
    PHAROS_REMOTE_COUNTERS(PHAROS_X)
#undef PHAROS_X
    case RemoteOutcome::kCount:
      break;
  }
  return "";
}

NamedCounts RemoteIntake::counts() const {
  NamedCounts out;
  for (std::size_t k = 0; k < counts_.size(); ++k) out.push_back({word_of(static_cast<RemoteOutcome>(k)), counts_[k]});
  out.push_back({"poses_lost", series_.lost()});
  out.push_back({"restarts", series_.restarts()});
  return out;
}

std::optional<pose_t> RemoteIntake::take(std::span<const std::uint8_t> message, const PeerClock* peer,
                                         const Clock& clock) {
  pose_t pose;
  last_ = judge(pose, message, peer, clock);
  ++counts_[static_cast<std::size_t>(last_)];
  if (last_ != RemoteOutcome::poses_taken) return std::nullopt;
  pose.source = "remote/" + config_.name;
  return pose;
}

std::optional<RemoteOutcome> RemoteIntake::other_than_ours(const pose_t& message) {
  const bool ours = message.source == config_.source && message.target == config_.target;
  if (ours && message.parent_frame == config_.frame && message.child_frame == config_.feature) return std::nullopt;
  foreign_ = printable(message.source, kMaxText) + " of " + printable(message.target, kMaxText) + " in " +
             printable(message.parent_frame, kMaxText) + ", " + printable(message.child_frame, kMaxText);
  return ours ? RemoteOutcome::poses_foreign : RemoteOutcome::poses_other;
}

RemoteOutcome RemoteIntake::judge(pose_t& message, std::span<const std::uint8_t> bytes, const PeerClock* peer,
                                  const Clock& clock) {
  constexpr std::size_t kMaxBytes = std::numeric_limits<int>::max();
  if (bytes.size() > kMaxBytes || !decode(message, bytes.data(), static_cast<int>(bytes.size()))) {
    return RemoteOutcome::messages_damaged;
  }
  if (const auto other = other_than_ours(message)) return *other;
  const std::int64_t now_ns = clock.monotonic_ns();
  switch (series_.take(message.sequence, message.utime, now_ns)) {
    case MessageSeries::Verdict::kRepeated:
      return RemoteOutcome::poses_repeated;
    case MessageSeries::Verdict::kUnproven:
      return RemoteOutcome::poses_unproven;
    case MessageSeries::Verdict::kDoubled:
      return RemoteOutcome::poses_doubled;
    case MessageSeries::Verdict::kNext:
      break;
  }
  if (peer != nullptr && peer->doubled(now_ns)) return RemoteOutcome::poses_doubled;
  if (message.valid == 0) {
    refusal_ = printable(message.status, kMaxText);
    return RemoteOutcome::poses_without_answer;
  }
  if (is_doubtful(message)) return RemoteOutcome::poses_doubtful;
  if (!is_positive(message.covariance)) return RemoteOutcome::poses_covariance;
  if (!is_possible(message)) return RemoteOutcome::poses_not_finite;
  return put_on_own_clock(message, peer, now_ns, clock.utc_ns());
}

RemoteOutcome RemoteIntake::put_on_own_clock(pose_t& message, const PeerClock* peer, std::int64_t now_ns,
                                             std::int64_t utc_ns) {
  std::int64_t own_ns = message.utime * kNsPerUs;
  std::int64_t sigma_ns = std::llround(config_.clock_sigma_s.value_or(0.0) * static_cast<double>(kNsPerSecond));
  if (peer != nullptr) {
    const std::optional<OwnTime> own = peer->own_time(own_ns, now_ns);
    if (!own) return RemoteOutcome::poses_no_clock;
    own_ns = own->monotonic_ns + (utc_ns - now_ns);
    sigma_ns = own->sigma_ns;
  }
  const std::int64_t age_ns = utc_ns - own_ns;
  if (static_cast<double>(age_ns) > config_.max_age_s * 1e9) return RemoteOutcome::poses_late;
  if (-age_ns > kAhead_ns + kAheadSigmas * sigma_ns) return RemoteOutcome::poses_ahead;
  const std::int64_t own_us = own_ns / kNsPerUs;
  // A clock of this computer that was set back by more than the oldest pose allows is followed.
  std::int64_t& last_us = last_utime_us_[message.station == 1 ? 1 : 0];
  const std::int64_t behind_us = last_us - own_us;
  if (behind_us >= 0 && static_cast<double>(behind_us) < config_.max_age_s * 1e6) return RemoteOutcome::poses_back;
  last_us = own_us;
  message.utime = own_us;
  const double stated_us = std::max(0, message.utime_sigma_us);
  const double sigma_us = std::hypot(stated_us, static_cast<double>(sigma_ns) / static_cast<double>(kNsPerUs));
  message.utime_sigma_us =
      static_cast<std::int32_t>(std::min(sigma_us, static_cast<double>(std::numeric_limits<std::int32_t>::max())));
  return RemoteOutcome::poses_taken;
}

}  // namespace pharos::host
