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
inline constexpr std::uint32_t kPtpStatusRegister = 0x200C;
inline constexpr std::uint32_t kClockLatchRegister = 0x2030;
inline constexpr std::uint32_t kClockRegister = 0x2034;  // 64 bits: the camera's clock at its last frame
inline constexpr std::uint32_t kScaleTable = 0x2100;     // mm a count: by mode, then by axis
inline constexpr std::uint32_t kOffsetTable = 0x2200;    // mm: the same
inline constexpr std::uint32_t kAxisStride = 8;
inline constexpr std::uint32_t kModeStride = 3 * kAxisStride;

inline constexpr std::uint32_t kPtpSlave = 9;  // values of PtpStatus, as IEEE 1588 numbers port states
inline constexpr std::uint32_t kPtpDisabled = 3;

/// What the simulated camera offers.
enum class OfferedFormats : std::uint8_t {
  kDepth,       // Coord3D_ABCY16, Coord3D_C16, Mono16
  kDepthApart,  // Coord3D_C16, Mono16
  kGrey,        // Mono8, Mono16: no depth camera at all
};

/// The GenICam description: the nodes of a Helios, or of a grey camera, that Pharos and its users meet.
std::string helios_description(OfferedFormats formats);

}  // namespace pharos::sim
