// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "host/clock/clock_map.hpp"
#include "host/device/depth_frame.hpp"

namespace pharos::host {

/// When a depth camera's frames were taken, in this computer's clocks.
///
/// By the arrival of each frame's first packet: ClockMap, with the camera's nanoseconds as ticks of 20 ns; what the
/// camera needs before it sends cannot be seen that way. Where the camera follows PTP its own time serves, as long as
/// it agrees with the arrivals but for whole seconds (TAI is 37 s ahead of UTC) and kMaxPtpDisagreement_ns.
class FrameClock {
 public:
  /// Takes the frame into account. Empty while the mapping is not known, or where the frame contradicts it.
  std::optional<MappedTime> time_of(const DepthFrame& frame);

  bool by_ptp() const { return by_ptp_; }
  /// Frames whose PTP time disagreed with their arrival and was not used.
  std::int64_t ptp_doubted() const { return ptp_rejected_; }
  const ClockMap& map() const { return map_; }

  /// What a frame may need from its middle to its first packet, and a busy computer until it sees that.
  static constexpr std::int64_t kMaxPtpDisagreement_ns = 300'000'000;
  /// Of PTP over switches that know nothing of it.
  static constexpr std::int64_t kPtpSigma_ns = 100'000;

 private:
  ClockMap map_;
  std::optional<std::uint32_t> session_;
  bool by_ptp_ = false;
  std::int64_t ptp_rejected_ = 0;
};

}  // namespace pharos::host
