// SPDX-License-Identifier: Apache-2.0
#include "host/device/pixel_format.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tools/sim/camera/frame_sequence.hpp"

namespace pharos::host {
namespace {

using Values = std::vector<std::uint16_t>;

TEST(PixelFormat, TakesZAndIntensityOutOfAbcy16) {
  // X, Y, Z, intensity, little-endian; two pixels.
  const std::vector<std::uint8_t> bytes{1, 0, 2, 0, 0x34, 0x12, 0x78, 0x56, 3, 0, 4, 0, 0xFF, 0xFF, 9, 0};
  Values depth(2);
  Values intensity(2);
  ASSERT_TRUE(unpack_abcy16(bytes, depth, intensity));
  EXPECT_EQ(depth, (Values{0x1234, 0xFFFF}));
  EXPECT_EQ(intensity, (Values{0x5678, 9}));
}

TEST(PixelFormat, TakesNothingFromBytesThatAreTooFewOrTooMany) {
  Values depth(2, 7);
  Values intensity(2, 7);
  for (const std::size_t size : {0u, 8u, 15u, 17u, 24u}) {
    EXPECT_FALSE(unpack_abcy16(std::vector<std::uint8_t>(size, 1), depth, intensity)) << size;
    EXPECT_FALSE(unpack_16(std::vector<std::uint8_t>(size, 1), depth)) << size;
    EXPECT_FALSE(unpack_8(std::vector<std::uint8_t>(size, 1), depth)) << size;
  }
  EXPECT_EQ(depth, (Values{7, 7}));
  EXPECT_EQ(intensity, (Values{7, 7}));
}

TEST(PixelFormat, SizesOfPayloadsFollowTheFormat) {
  EXPECT_EQ(payload_bytes(kCoord3dAbcy16, 640, 480), 640u * 480u * 8u);
  EXPECT_EQ(payload_bytes(kCoord3dC16, 640, 480), 640u * 480u * 2u);
  EXPECT_EQ(payload_bytes(kMono16, 640, 480), 640u * 480u * 2u);
}

// A frame of the simulated camera is read back unchanged, in the scale that the camera states.
TEST(PixelFormat, ReadsWhatTheSimulatedCameraSends) {
  sim::FrameSequence sequence{2, 1, 0.00025, {{0.1f, -0.2f}, {0.3f, 0.4f}}, {}};
  sequence.frames.push_back({{100, 200}, {12'000, 0}, std::nullopt});
  const sim::WireScale wire{{0.0001, 0.0001, 0.0001}, {-3.0, -3.0, 0.5}};
  std::vector<std::uint8_t> bytes(16);
  sim::write_payload(sequence, sequence.frames[0], kCoord3dAbcy16, wire, bytes);
  Values depth(2);
  Values intensity(2);
  ASSERT_TRUE(unpack_abcy16(bytes, depth, intensity));
  EXPECT_NEAR(depth[0] * 0.0001 + 0.5, 3.0, 1e-9);
  EXPECT_NEAR((bytes[0] | bytes[1] << 8) * 0.0001 - 3.0, 0.3, 1e-4) << "X";
  EXPECT_EQ(depth[1], 0xFFFF) << "none";
  EXPECT_EQ(intensity, (Values{100, 200}));
}

TEST(PixelFormat, GreyFramesComeAsTheSimulatedCameraSendsThem) {
  sim::FrameSequence sequence{2, 1, 0.00025, {}, {}};
  sequence.frames.push_back({{0x1234, 0xFFFF}, {}, std::nullopt});
  std::vector<std::uint8_t> bytes(4);
  Values grey(2);
  sim::write_payload(sequence, sequence.frames[0], kMono16, {}, bytes);
  ASSERT_TRUE(unpack_16(bytes, grey));
  EXPECT_EQ(grey, (Values{0x1234, 0xFFFF}));
  bytes.resize(payload_bytes(kMono8, 2, 1));
  sim::write_payload(sequence, sequence.frames[0], kMono8, {}, bytes);
  ASSERT_TRUE(unpack_8(bytes, grey));
  EXPECT_EQ(grey, (Values{0x1212, 0xFFFF})) << "white stays white";
}

TEST(FrameSequence, IsShownToAndFroWithoutAJump) {
  sim::FrameSequence sequence;
  for (std::uint16_t i = 0; i < 3; ++i) sequence.frames.push_back({{i}, {i}, std::nullopt});
  Values shown;
  for (std::uint64_t i = 0; i < 9; ++i) shown.push_back(sequence.at(i).depth[0]);
  EXPECT_EQ(shown, (Values{0, 1, 2, 1, 0, 1, 2, 1, 0}));
}

}  // namespace
}  // namespace pharos::host
