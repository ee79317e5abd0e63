// SPDX-License-Identifier: Apache-2.0
// The loader's own frames and payloads compared with those of wire, which all other programs use.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "firmware/boot/frame_receiver.hpp"
#include "firmware/boot/frame_sender.hpp"
#include "firmware/boot/payloads.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "unit/boot/images.hpp"

namespace pharos::boot::test {
namespace {

Bytes encode(wire::FrameEncoder& encoder, wire::MessageType type, const Bytes& payload) {
  Bytes line(wire::kMaxLineFrame);
  line.resize(encoder.encode(type, payload, line));
  return line;
}

Bytes random_payload(std::mt19937& random, std::size_t size, bool zeros) {
  Bytes payload(size);
  for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(zeros ? random() % 2 : random() | 1);
  return payload;
}

TEST(FrameReceiver, TakesEveryFrameOfTheProtocolUpToTheLongestRequest) {
  wire::FrameEncoder encoder;
  FrameReceiver receiver;
  std::mt19937 random(1);
  for (std::size_t size = 0; size <= wire::LoaderData::kMaxBytes; ++size) {
    for (const bool zeros : {false, true}) {
      const Bytes payload = random_payload(random, size, zeros);
      const std::uint16_t sequence = encoder.next_sequence();
      const Bytes line = encode(encoder, wire::MessageType::kLoaderData, payload);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) ASSERT_FALSE(receiver.push(line[i])) << size;
      ASSERT_TRUE(receiver.push(line.back())) << size;
      EXPECT_EQ(receiver.type(), wire::MessageType::kLoaderData);
      EXPECT_EQ(receiver.sequence()[0] | (receiver.sequence()[1] << 8), sequence);
      EXPECT_TRUE(std::equal(payload.begin(), payload.end(), receiver.payload(),
                             receiver.payload() + receiver.payload_bytes()));
      EXPECT_FALSE(receiver.push(0)) << "told once";
    }
  }
  for (const std::size_t size : {wire::LoaderData::kMaxBytes + 1, wire::kMaxPayload}) {
    for (const std::uint8_t byte : encode(encoder, wire::MessageType::kLoaderData, Bytes(size, 7))) {
      ASSERT_FALSE(receiver.push(byte)) << "longer than any request";
    }
  }
}

TEST(FrameReceiver, TakesNoBrokenFrameAndEveryWholeOneAfterIt) {
  std::mt19937 random(2);
  FrameReceiver receiver;
  for (int trial = 0; trial < 20'000; ++trial) {
    wire::FrameEncoder encoder;
    const Bytes good =
        encode(encoder, wire::MessageType::kLoaderBegin, random_payload(random, random() % 60, trial % 2 == 0));
    Bytes broken = good;
    const std::size_t at =
        1 + random() % (broken.size() -
                        2);  // not a delimiter: the bytes between two delimiters would still be a complete frame
    if (trial % 3 == 0) {
      broken[at] ^= static_cast<std::uint8_t>(1 << random() % 8);
    } else if (trial % 3 == 1) {
      broken.erase(broken.begin() + static_cast<std::ptrdiff_t>(at));
    } else {
      broken.insert(broken.begin() + static_cast<std::ptrdiff_t>(at), static_cast<std::uint8_t>(random() | 1));
    }
    for (const std::uint8_t byte : broken) ASSERT_FALSE(receiver.push(byte)) << trial;
    bool came = false;
    for (const std::uint8_t byte : good) came = receiver.push(byte);
    ASSERT_TRUE(came) << trial;
  }
}

TEST(FrameSender, IsDecodedByTheProtocolsDecoder) {
  FrameSender sender;
  wire::FrameDecoder decoder;
  std::mt19937 random(3);
  for (std::uint16_t number = 0; number < 2000; ++number) {
    const Bytes payload = random_payload(random, 1 + random() % FrameSender::kMaxPayload, number % 2 == 0);
    std::optional<wire::Frame> frame;
    for (const std::uint8_t byte : sender.encode(wire::MessageType::kHello, payload)) {
      ASSERT_FALSE(frame);
      frame = decoder.push(byte);
    }
    ASSERT_TRUE(frame) << number;
    EXPECT_EQ(frame->sequence, number);
    EXPECT_TRUE(std::ranges::equal(frame->payload, payload));
  }
}

template <class M, class Payload>
bool same_bytes(const M& message, const Payload& payload) {
  std::array<std::uint8_t, M::kMaxBytes> encoded{};
  const std::size_t size = wire::encode_payload(message, encoded);
  return std::ranges::equal(std::span(encoded).first(size), bytes_of(payload));
}

TEST(Payloads, LieAsTheByteTablesSay) {
  wire::Hello hello;
  hello.role = wire::Role::kLoader;
  hello.reset_cause = wire::ResetCause::kWatchdog;
  hello.modes = 5;
  hello.firmware_major = 1;
  hello.firmware_minor = 2;
  hello.firmware_patch = 3;
  hello.start_count = 0x1234;
  hello.tick_rate_hz = 50'000'000;
  hello.sensors = 0xFFF;
  hello.time_ticks = 0x0012345678ABCDEF;
  hello.unique_id = 0xCAFE0001;
  hello.board = wire::Text<24>("a board");
  hello.target = wire::Text<24>("a target");
  EXPECT_TRUE(same_bytes(hello, HelloPayload{wire::Role::kLoader,
                                             3,
                                             5,
                                             {1, 2, 3},
                                             0x1234,
                                             50'000'000,
                                             0xFFF,
                                             0x78ABCDEF,
                                             0x00123456,
                                             0xCAFE0001,
                                             hello.board.characters,
                                             hello.target.characters}));
  const wire::LoaderInfo info{1, 256, 0x40000, 0x30000, wire::Text<24>("a board")};
  EXPECT_TRUE(same_bytes(info, InfoPayload{1, 256, 0x40000, 0x30000, info.board.characters}));
  const wire::LoaderBegin begin{20'000, 0x12345678, wire::Text<24>("a board")};
  EXPECT_TRUE(same_bytes(begin, BeginPayload{20'000, 0x12345678, begin.board.characters}));
  const wire::Nak nak{0x43, 0x1234, wire::NakReason::kBadCrc, 0x89ABCDEF};
  EXPECT_TRUE(same_bytes(nak, NakPayload{0x43, 0x1234, 6, 0x89ABCDEF}));
  wire::LoaderData data;
  data.offset = 0x00010203;
  data.data.resize(9);
  std::array<std::uint8_t, wire::LoaderData::kMaxBytes> encoded{};
  ASSERT_EQ(wire::encode_payload(data, encoded), sizeof(DataHead) + 9);
  EXPECT_TRUE(std::ranges::equal(bytes_of(DataHead{0x00010203, 9}), std::span(encoded).first(sizeof(DataHead))));
}

}  // namespace
}  // namespace pharos::boot::test
