// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "host/clock/clock_map.hpp"
#include "host/device/depth_frame.hpp"

namespace pharos::host {

/// Converts the exposure times of a depth camera's frames to this computer's clocks.
///
/// The conversion uses the arrival of each frame's first packet: ClockMap, with the camera's nanoseconds as ticks of
/// 20 ns. The camera's delay before it sends is not observable in this way. If the camera follows PTP its own time is
/// used, as long as it agrees with the arrivals within kMaxPtpDisagreement_ns, apart from whole seconds (TAI is 37 s
/// ahead of UTC). It also shows the camera's delay, which is taken off when the camera no longer follows PTP.
class FrameClock {
 public:
  /// Updates the mapping with the frame. Empty while the mapping is unknown, or if the frame contradicts it.
  std::optional<MappedTime> time_of(const DepthFrame& frame);

  bool by_ptp() const { return by_ptp_; }
  /// Of the newest times; 0 while there are none.
  std::int64_t sigma_ns() const;
  /// Frames whose PTP time disagreed with their arrival and was not used.
  std::int64_t ptp_doubted() const { return ptp_rejected_; }
  const ClockMap& map() const { return map_; }

  /// Maximum time from the middle of the exposure until a busy computer has received the first packet.
  static constexpr std::int64_t kMaxPtpDisagreement_ns = 300'000'000;
  /// Accuracy of PTP over switches without PTP support.
  static constexpr std::int64_t kPtpSigma_ns = 100'000;

 private:
  std::optional<MappedTime> less_delay(const std::optional<MappedTime>& mapped) const;

  ClockMap map_;
  std::optional<std::uint32_t> session_;
  std::optional<std::int64_t> delay_ns_;  // from the exposure to the mapped time, as PTP showed it in this session
  bool by_ptp_ = false;
  std::int64_t ptp_rejected_ = 0;
};

}  // namespace pharos::host
