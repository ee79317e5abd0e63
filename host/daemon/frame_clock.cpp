// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/frame_clock.hpp"

#include <cstdlib>

#include "host/support/time_units.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::host {
namespace {

// Frames: a second at 30 frames/s.
constexpr std::int64_t kDelayMemory = 30;

std::int64_t nearest_second_ns(std::int64_t ns) {
  const std::int64_t half = ns < 0 ? -kNsPerSecond / 2 : kNsPerSecond / 2;
  return (ns + half) / kNsPerSecond * kNsPerSecond;
}

}  // namespace

std::optional<MappedTime> FrameClock::time_of(const DepthFrame& frame) {
  by_ptp_ = false;
  if (frame.clock == CameraClock::kHost) return MappedTime{frame.camera_ns, frame.arrival_monotonic_ns, 0};
  if (session_ && *session_ != frame.session) {
    map_.restart();
    delay_ns_.reset();
  }
  session_ = frame.session;
  const std::int64_t ticks = frame.camera_ns / kNanosecondsPerTick;
  if (!map_.add(ticks, frame.arrival_utc_ns, frame.arrival_monotonic_ns)) return std::nullopt;
  std::optional<MappedTime> mapped = map_.map(ticks);
  if (!mapped || frame.clock != CameraClock::kPtp) return less_delay(mapped);
  const std::int64_t ahead_ns = frame.camera_ns - mapped->utc_ns;
  const std::int64_t early_ns = ahead_ns - nearest_second_ns(ahead_ns);  // negative: before the arrival
  if (std::abs(early_ns) > kMaxPtpDisagreement_ns) {
    ++ptp_rejected_;
    return less_delay(mapped);
  }
  by_ptp_ = true;
  if (!delay_ns_) delay_ns_ = -early_ns;
  *delay_ns_ += (-early_ns - *delay_ns_) / kDelayMemory;
  return MappedTime{mapped->utc_ns + early_ns, mapped->monotonic_ns + early_ns, kPtpSigma_ns};
}

std::int64_t FrameClock::sigma_ns() const {
  if (!map_.synchronised()) return 0;
  return by_ptp_ ? kPtpSigma_ns : map_.sigma_ns() + (delay_ns_ ? kPtpSigma_ns : 0);
}

// Both errors are taken as of one sign.
std::optional<MappedTime> FrameClock::less_delay(const std::optional<MappedTime>& mapped) const {
  if (!mapped || !delay_ns_) return mapped;
  return MappedTime{mapped->utc_ns - *delay_ns_, mapped->monotonic_ns - *delay_ns_, mapped->sigma_ns + kPtpSigma_ns};
}

}  // namespace pharos::host
