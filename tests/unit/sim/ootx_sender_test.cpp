// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ootx_sender.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/sim/ootx_reader.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {
namespace {

TEST(OotxSender, BuildsTheBytesOfARealStation) {
  StationAnnouncement station;
  station.id = 0xBEC08E38u;
  station.rotor[0] = {from_half(0x23FB), from_half(0x0CE2), from_half(0x9762), from_half(0xB53A), from_half(0x1C5A)};
  station.rotor[1] = {from_half(0x28E4), from_half(0x1898), from_half(0x9700), from_half(0xBE08), from_half(0x9DE6)};
  station.acceleration = {-127, -3, 9};
  station.mode = 1;
  EXPECT_EQ(to_hex(announcement_bytes(station)), "063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100");
  EXPECT_NEAR(station.rotor[0].phase_rad, 0.015587, 1e-6);
  EXPECT_NEAR(station.rotor[1].gibbous_phase_rad, -1.50781, 1e-5);
  EXPECT_NEAR(station.rotor[1].gibbous_magnitude_rad, -0.00576019, 1e-8);
}

TEST(OotxSender, HalfPrecisionReadsBackEveryValueAndRoundsToNearest) {
  for (std::uint32_t half = 0; half < 0x10000u; ++half) {
    if ((half & 0x7C00u) == 0x7C00u) continue;  // infinities and not-a-number
    EXPECT_EQ(to_half(from_half(static_cast<std::uint16_t>(half))), half);
  }
  EXPECT_EQ(to_half(1.0), 0x3C00u);
  EXPECT_EQ(to_half(-2.0), 0xC000u);
  EXPECT_EQ(to_half(65504.0), 0x7BFFu);
  EXPECT_EQ(to_half(0x1p-24), 0x0001u);
  EXPECT_EQ(to_half(1.0 + 0x1p-11), 0x3C00u) << "a tie goes to the even neighbour";
  EXPECT_EQ(to_half(1.0 + 3 * 0x1p-11), 0x3C02u);
}

TEST(OotxSender, AFrameOfARealPayloadHas358Bits) {
  EXPECT_EQ(ootx_frame_bits(std::vector<std::uint8_t>(33, 0)).size(), 358u);
  EXPECT_EQ(frame_checksum({'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0xCBF43926u);
}

TEST(OotxSender, FramesReadBack) {
  RandomStream random(3, "ootx test");
  for (std::size_t size : {31u, 33u, 2u, 64u}) {
    std::vector<std::uint8_t> payload(size);
    for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random.bits());
    const std::vector<std::string> frames = read_ootx(ootx_frame_bits(payload));
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0], to_hex(payload));
  }
}

}  // namespace
}  // namespace pharos::sim
