// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "pharos/wire/cobs.hpp"
#include "pharos/wire/crc32.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"

namespace pharos::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Received {
  MessageType type;
  std::uint16_t sequence;
  Bytes payload;
};

std::vector<Received> feed(FrameDecoder& decoder, const Bytes& bytes) {
  std::vector<Received> frames;
  for (const std::uint8_t byte : bytes) {
    if (const auto frame = decoder.push(byte)) {
      frames.push_back({frame->type, frame->sequence, {frame->payload.begin(), frame->payload.end()}});
    }
  }
  return frames;
}

Bytes encode(FrameEncoder& encoder, MessageType type, const Bytes& payload) {
  Bytes line(kMaxLineFrame);
  line.resize(encoder.encode(type, payload, line));
  return line;
}

/// A frame with any version, number and length, by hand.
Bytes handmade(std::uint8_t version, std::uint8_t type, std::uint16_t sequence, const Bytes& payload) {
  Bytes plain{version, type, static_cast<std::uint8_t>(sequence), static_cast<std::uint8_t>(sequence >> 8)};
  plain.insert(plain.end(), payload.begin(), payload.end());
  const std::uint32_t crc = crc32(plain);
  for (int i = 0; i < 4; ++i) plain.push_back(static_cast<std::uint8_t>(crc >> (8 * i)));
  Bytes line(stuffed_size(plain.size()));
  CobsWriter writer(line);
  writer.put(plain);
  line.resize(writer.finish());
  line.insert(line.begin(), 0);
  line.push_back(0);
  return line;
}

Bytes time_frame(std::uint16_t sequence) {
  return handmade(kProtocolVersion, static_cast<std::uint8_t>(MessageType::kTime), sequence, Bytes(8, 1));
}

TEST(Frame, ComesBackAsItWasSentAtEveryLength) {
  FrameEncoder encoder;
  FrameDecoder decoder;
  for (std::size_t size = 0; size <= kMaxPayload; ++size) {
    for (const auto fill : {std::uint8_t{0x00}, std::uint8_t{0x5A}}) {
      const auto sequence = encoder.next_sequence();
      const Bytes line = encode(encoder, MessageType::kSweep, Bytes(size, fill));
      ASSERT_LE(line.size(), line_size(size));
      const auto frames = feed(decoder, line);
      ASSERT_EQ(frames.size(), 1u);
      EXPECT_EQ(frames[0].type, MessageType::kSweep);
      EXPECT_EQ(frames[0].sequence, sequence);
      EXPECT_EQ(frames[0].payload, Bytes(size, fill));
    }
  }
  EXPECT_EQ(decoder.counters().frames, 2 * (kMaxPayload + 1));
  EXPECT_EQ(decoder.counters().frames_lost, 0u);
  EXPECT_EQ(decoder.counters().garbage_bytes, 0u);
}

TEST(FrameEncoder, RefusesWhatDoesNotFitAndUsesNoNumber) {
  FrameEncoder encoder;
  Bytes line(kMaxLineFrame);
  EXPECT_EQ(encoder.encode(MessageType::kSweep, Bytes(kMaxPayload + 1), line), 0u);
  for (std::size_t room = 0; room < line_size(5); ++room) {
    EXPECT_EQ(encoder.encode(MessageType::kSweep, Bytes(5, 1), std::span(line).first(room)), 0u) << room;
  }
  EXPECT_EQ(encoder.next_sequence(), 0);
  EXPECT_EQ(encoder.encode(MessageType::kSweep, Bytes(5, 1), std::span(line).first(line_size(5))), line_size(5));
  EXPECT_EQ(encoder.next_sequence(), 1);
}

TEST(FrameDecoder, FindsTheFirstFrameAfterAnyGarbage) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    FrameDecoder decoder;
    Bytes garbage(random() % 2000);
    for (auto& byte : garbage) byte = static_cast<std::uint8_t>(random());
    EXPECT_TRUE(feed(decoder, garbage).empty());
    EXPECT_EQ(feed(decoder, time_frame(7)).size(), 1u);
  }
}

TEST(FrameDecoder, DropsTheRestOfAFrameThatBeganBeforeItListenedUncounted) {
  FrameDecoder decoder;
  Bytes line = time_frame(0);
  line.erase(line.begin(), line.begin() + 5);
  EXPECT_TRUE(feed(decoder, line).empty());
  EXPECT_EQ(feed(decoder, time_frame(1)).size(), 1u);
  const LinkCounters& counters = decoder.counters();
  EXPECT_EQ(counters.bad_crc + counters.bad_stuffing + counters.too_short + counters.too_long, 0u);
  EXPECT_EQ(counters.garbage_bytes, line.size() - 1);
}

TEST(FrameDecoder, NamesAnotherProtocolVersion) {
  FrameDecoder decoder;
  EXPECT_EQ(decoder.unsupported_version(), std::nullopt);
  EXPECT_TRUE(feed(decoder, handmade(9, 0x10, 4, {1, 2, 3})).empty());
  EXPECT_EQ(decoder.unsupported_version(), 9);
  EXPECT_EQ(decoder.counters().wrong_version, 1u);
  // A corrupt frame is not counted as one of another version.
  Bytes broken = handmade(8, 0x10, 4, {1, 2, 3});
  broken[6] ^= 2;
  EXPECT_TRUE(feed(decoder, broken).empty());
  EXPECT_EQ(decoder.unsupported_version(), 9);
  EXPECT_EQ(decoder.counters().bad_crc, 1u);
}

TEST(FrameDecoder, SkipsTypesOfTheFutureWithoutSeeingALoss) {
  FrameDecoder decoder;
  Bytes line = time_frame(0);
  const Bytes future = handmade(kProtocolVersion, 0xEE, 1, Bytes(500, 9));
  const Bytes next = time_frame(2);
  line.insert(line.end(), future.begin(), future.end());
  line.insert(line.end(), next.begin(), next.end());
  EXPECT_EQ(feed(decoder, line).size(), 2u);
  EXPECT_EQ(decoder.counters().unknown_type, 1u);
  EXPECT_EQ(decoder.counters().frames_lost, 0u);
}

TEST(FrameDecoder, ReportsTooLongAndTooShortAndGoesOn) {
  FrameDecoder decoder;
  feed(decoder, time_frame(0));
  feed(decoder, handmade(kProtocolVersion, 0x10, 1, Bytes(kMaxPayload + 50, 9)));
  EXPECT_EQ(decoder.counters().too_long, 1u);
  feed(decoder, Bytes(1'000'000, 0x55));
  feed(decoder, {0});
  EXPECT_EQ(decoder.counters().too_long, 2u);
  feed(decoder, {4, 1, 2, 3, 0});
  EXPECT_EQ(decoder.counters().too_short, 1u);
  EXPECT_EQ(feed(decoder, time_frame(1)).size(), 1u);
}

TEST(FrameDecoder, CountsLostFramesByTheirNumbers) {
  FrameDecoder decoder;
  for (const std::uint16_t sequence : std::initializer_list<std::uint16_t>{65530, 65531, 65535, 2, 3})
    feed(decoder, time_frame(sequence));
  EXPECT_EQ(decoder.counters().frames, 5u);
  EXPECT_EQ(decoder.counters().frames_lost, 3u + 2u);
  EXPECT_EQ(decoder.counters().restarts, 0u);
}

TEST(FrameDecoder, DropsWhatComesTwiceOrTooLate) {
  FrameDecoder decoder;
  std::vector<std::uint16_t> passed;
  for (const std::uint16_t sequence : std::initializer_list<std::uint16_t>{10, 10, 12, 11, 12, 13}) {
    for (const auto& frame : feed(decoder, time_frame(sequence))) passed.push_back(frame.sequence);
  }
  EXPECT_EQ(passed, (std::vector<std::uint16_t>{10, 12, 13}));
  EXPECT_EQ(decoder.counters().repeated, 3u);
  EXPECT_EQ(decoder.counters().frames_lost, 1u);
}

TEST(FrameDecoder, TakesARestartedSenderAtOnceAndCountsNoLoss) {
  const auto hello = [](std::uint8_t fill) {
    return handmade(kProtocolVersion, static_cast<std::uint8_t>(MessageType::kHello), 0, Bytes(76, fill));
  };
  for (const std::uint16_t last : std::initializer_list<std::uint16_t>{0, 3, 40000, 65000, 65535}) {
    FrameDecoder decoder;
    feed(decoder, time_frame(last));
    EXPECT_EQ(feed(decoder, hello(1)).size(), 1u);
    EXPECT_EQ(feed(decoder, time_frame(1)).size(), 1u);
    EXPECT_EQ(decoder.counters().restarts, last == 65535 ? 0u : 1u);  // 0 always follows 65,535
    EXPECT_EQ(decoder.counters().frames_lost, 0u);
  }
}

TEST(FrameDecoder, TakesTheHelloOfALoaderAndOfTheProgramRightAfterIt) {
  FrameDecoder decoder;
  const auto type = static_cast<std::uint8_t>(MessageType::kHello);
  EXPECT_EQ(feed(decoder, handmade(kProtocolVersion, type, 0, Bytes(76, 1))).size(), 1u);
  EXPECT_EQ(feed(decoder, handmade(kProtocolVersion, type, 0, Bytes(76, 2))).size(), 1u);
  EXPECT_EQ(decoder.counters().restarts, 1u);
}

TEST(FrameDecoder, ForgetsACutFrameWhenTheLineIsRestarted) {
  FrameDecoder decoder;
  const Bytes line = time_frame(0);
  feed(decoder, Bytes(line.begin(), line.begin() + 9));
  decoder.restart();
  EXPECT_EQ(feed(decoder, time_frame(1)).size(), 1u);
  EXPECT_EQ(decoder.counters().bad_crc + decoder.counters().bad_stuffing, 0u);
  EXPECT_EQ(decoder.counters().garbage_bytes, 8u);
}

}  // namespace
}  // namespace pharos::wire
