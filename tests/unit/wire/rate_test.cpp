// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "pharos/lighthouse/decoder_counters.hpp"
#include "unit/wire/random_messages.hpp"

namespace pharos::wire {
namespace {

// The table of rates in proto/README.md.
constexpr double kBaud = 460'800.0;
constexpr double kBitsPerByte = 10.0;  // 8N1
constexpr double kSlotsPerSecond = 120.0;

template <class M>
double line_bytes(const M& message) {
  FrameEncoder encoder;
  test::Bytes payload(kMaxPayload);
  payload.resize(encode_payload(message, payload));
  EXPECT_FALSE(payload.empty());
  return static_cast<double>(test::frame_bytes(encoder, M::kType, payload).size());
}

double fraction(double bytes_per_second) { return bytes_per_second * kBitsPerByte / kBaud; }

Sweep sweep_with(std::size_t hits) {
  Sweep sweep;
  sweep.flash_start_ticks = 0x0123456789ABCD;
  sweep.flash_length_ticks = 3125;
  sweep.period_sixteenth_ticks = 13'333'333;
  for (std::size_t i = 0; i < hits; ++i) sweep.hits.push_back({static_cast<std::uint8_t>(i % 32), 208, 300'033});
  return sweep;
}

TEST(LineRate, TwelveSensorsAtFullRateLeaveHalfTheLineFree) {
  EXPECT_EQ(line_bytes(sweep_with(12)), 115.0);
  EXPECT_NEAR(fraction(kSlotsPerSecond * line_bytes(sweep_with(12))), 0.2995, 0.0005);
}

TEST(LineRate, AllThatATargetSaysLeavesHalfTheLineFree) {
  Counters decoder;
  for_each_counter(lighthouse::DecoderCounters{},
                   [&](const char*, std::uint32_t, const char*) { decoder.values.push_back(0xFFFFFFFF); });
  Counters device;
  for_each_counter(DeviceCounters{}, [&](const char*, std::uint32_t, const char*) { device.values.push_back(~0u); });
  Ootx ootx;
  ootx.data.resize(33);
  // Two stations: in every slot one sweeps (12 hits) and the other flashes with its laser off.
  const double sweeps = kSlotsPerSecond * (line_bytes(sweep_with(12)) + line_bytes(sweep_with(0)));
  const double rest = line_bytes(decoder) + line_bytes(device) + line_bytes(Hello{}) + 10.0 * line_bytes(Time{}) +
                      2.0 * line_bytes(ootx) / 3.0;
  EXPECT_LT(fraction(sweeps + rest), 0.5);
  EXPECT_NEAR(fraction(sweeps + rest), 0.395, 0.01);
}

TEST(LineRate, RawEdgesOfTwelveSensorsAndTwoStationsFit) {
  // Per slot: two flashes and one hit on each sensor, edges in the order of capture: first all rises, then all falls.
  RawEdgesPacker packer;
  FrameEncoder encoder;
  double bytes = 0.0;
  double edges = 0.0;
  const auto deliver = [&] {
    bytes += static_cast<double>(test::frame_bytes(encoder, MessageType::kRawEdges, packer.payload(0)).size());
    packer.clear();
  };
  const auto push = [&](const RawEdge& edge) {
    ++edges;
    if (packer.push(edge)) return;
    deliver();
    packer.push(edge);
  };
  for (std::int64_t slot = 0; slot < 120; ++slot) {
    const std::int64_t start = slot * 416'667 + 3'000'000'000;
    for (const std::int64_t flash : {start, start + 20'400}) {
      for (std::uint8_t s = 0; s < 12; ++s) push({flash + 13 * s, s, true});
      for (std::uint8_t s = 0; s < 12; ++s) push({flash + 3500 + 29 * s, s, false});
    }
    for (std::uint8_t s = 0; s < 12; ++s) {
      push({start + 200'000 + 900 * s, s, true});
      push({start + 200'208 + 900 * s, s, false});
    }
  }
  deliver();
  EXPECT_EQ(edges, 120.0 * 72.0);
  EXPECT_LT(bytes / edges, 3.0);
  EXPECT_LT(fraction(bytes), 0.6);
  RecordProperty("bytes_per_second", static_cast<int>(bytes));
}

}  // namespace
}  // namespace pharos::wire
