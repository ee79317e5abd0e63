// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace pharos::host {

/// Whether a camera's clock follows PTP. 1 to 9 are the port states of IEEE 1588-2008, table 8, which the cameras tell
/// by the words of GenICam's SFNC (PtpStatus).
enum class PtpState : std::uint8_t {
  kOff,  // not asked for, or no camera is open
  kInitializing,
  kFaulty,
  kDisabled,
  kListening,
  kPreMaster,
  kMaster,
  kPassive,
  kUncalibrated,
  kSlave,    // the only state in which the camera's time is that of the network
  kAbsent,   // the camera does not offer it
  kRefused,  // the camera does not take the order to follow it
  kUnread,   // the camera's state cannot be read, or is none of the above
};

namespace ptp_detail {
inline constexpr std::array<std::string_view, 9> kStandardWords{
    "Initializing", "Faulty", "Disabled", "Listening", "PreMaster", "Master", "Passive", "Uncalibrated", "Slave"};
inline constexpr std::array<std::string_view, 13> kTexts{"",
                                                         "PTP initializing",
                                                         "PTP faulty",
                                                         "PTP disabled",
                                                         "PTP listening",
                                                         "PTP pre-master",
                                                         "PTP master",
                                                         "PTP passive",
                                                         "PTP uncalibrated",
                                                         "PTP slave",
                                                         "PTP not offered",
                                                         "PTP refused",
                                                         "PTP state unknown"};
}  // namespace ptp_detail

/// The state that a camera tells by the standard's word; kUnread for any other one.
constexpr PtpState ptp_state_of(std::string_view word) {
  const auto& words = ptp_detail::kStandardWords;
  const auto at = std::find(words.begin(), words.end(), word);
  return at == words.end() ? PtpState::kUnread : static_cast<PtpState>(at - words.begin() + 1);
}

/// For status and log; empty for kOff.
constexpr std::string_view text_of(PtpState state) { return ptp_detail::kTexts[static_cast<std::size_t>(state)]; }

}  // namespace pharos::host
