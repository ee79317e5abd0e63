// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace pharos::sim {

/// Scan3dOperatingMode, in the order of its register's values.
inline constexpr std::array<const char*, 6> kHeliosModes{"Distance1250mmSingleFreq", "Distance3000mmSingleFreq",
                                                         "Distance4000mmSingleFreq", "Distance5000mmMultiFreq",
                                                         "Distance6000mmSingleFreq", "Distance8300mmMultiFreq"};

// Registers of the simulated Helios beside those that the fake camera of Aravis has: 32 bits, big-endian, from 0x2000,
// and two tables of 64-bit floats.
inline constexpr std::uint32_t kModeRegister = 0x2000;
inline constexpr std::uint32_t kAxisRegister = 0x2004;
inline constexpr std::uint32_t kPtpEnableRegister = 0x2008;
inline constexpr std::uint32_t kPtpStatusRegister = 0x200C;  // of the last latch
inline constexpr std::uint32_t kPtpLatchRegister = 0x2024;
inline constexpr std::uint32_t kClockLatchRegister = 0x2030;
inline constexpr std::uint32_t kClockRegister = 0x2034;  // 64 bits: the camera's clock at its last frame
inline constexpr std::uint32_t kScaleTable = 0x2100;     // mm a count: by mode, then by axis
inline constexpr std::uint32_t kOffsetTable = 0x2200;    // mm: the same
inline constexpr std::uint32_t kAxisStride = 8;
inline constexpr std::uint32_t kModeStride = 3 * kAxisStride;

inline constexpr std::uint32_t kPtpSlave = 9;  // values of PtpStatus, as IEEE 1588 numbers port states
inline constexpr std::uint32_t kPtpDisabled = 3;
inline constexpr std::uint32_t kPtpListening = 4;

/// What the simulated camera offers.
enum class OfferedFormats : std::uint8_t {
  kDepth,       // Coord3D_ABCY16, Coord3D_C16, Mono16
  kDepthApart,  // Coord3D_C16, Mono16
  kGrey,        // Mono8, Mono16: no depth camera at all
};

/// Its PTP nodes.
enum class PtpNames : std::uint8_t {
  kNew,   // PtpEnable, PtpStatus, PtpDataSetLatch
  kOld,   // GevIEEE1588, GevIEEE1588Status, GevIEEE1588DataSetLatch
  kNone,  // it does not know PTP
};

/// The GenICam description: the nodes of a Helios, or of a grey camera, that Pharos and its users meet.
/// `ptp_refused`: an order to follow PTP is an error.
std::string helios_description(OfferedFormats formats, PtpNames ptp_names, bool ptp_refused);

}  // namespace pharos::sim
