// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "unit/wire/random_messages.hpp"

namespace pharos::wire {
namespace {

using test::AllMessages;
using test::Bytes;
using test::RandomMessages;

TEST(Messages, CoverEveryType) {
  std::size_t types = 0;
  for (int number = 0; number < 256; ++number) types += is_known(static_cast<MessageType>(number)) ? 1u : 0u;
  EXPECT_EQ(AllMessages::kSize, types);
}

TEST(Messages, RoundTripExactlyWithAnyFields) {
  RandomMessages random(11);
  AllMessages::for_each([&](auto example) {
    using M = decltype(example);
    std::size_t longest = 0;
    for (int i = 0; i < 2000; ++i) {
      const Bytes payload = random.payload_of<M>();
      if (M::kMaxBytes > 0) {
        ASSERT_FALSE(payload.empty()) << name_of(M::kType);
      }
      longest = std::max(longest, payload.size());
      const auto message = decode_payload<M>(payload);
      ASSERT_TRUE(message.ok()) << name_of(M::kType) << " error " << static_cast<int>(message.error());
      Bytes again(kMaxPayload);
      again.resize(encode_payload(*message, again));
      ASSERT_EQ(again, payload) << name_of(M::kType);
    }
    EXPECT_LE(longest, M::kMaxBytes) << name_of(M::kType);
    EXPECT_LE(M::kMaxBytes, kMaxPayload);
    EXPECT_GE(longest + 12, M::kMaxBytes) << name_of(M::kType) << ": kMaxBytes is not the worst case";
  });
}

TEST(Messages, EveryCutIsTooShortAndEveryExtraByteTooLong) {
  RandomMessages random(12);
  AllMessages::for_each([&](auto example) {
    using M = decltype(example);
    for (int i = 0; i < 20; ++i) {
      Bytes payload = random.payload_of<M>();
      for (std::size_t size = 0; size < payload.size(); ++size) {
        ASSERT_EQ(decode_payload<M>(std::span(payload).first(size)).error(), DecodeError::kTooShort)
            << name_of(M::kType) << " cut to " << size;
      }
      payload.push_back(0);
      ASSERT_EQ(decode_payload<M>(payload).error(), DecodeError::kTrailingBytes) << name_of(M::kType);
    }
  });
}

TEST(Messages, NeverWritePastTheEnd) {
  RandomMessages random(13);
  AllMessages::for_each([&](auto example) {
    using M = decltype(example);
    M message;
    random.fill(message);
    Bytes out(kMaxPayload);
    const std::size_t whole = encode_payload(message, out);
    for (std::size_t room = 0; room < whole; ++room) {
      Bytes small(room);  // a separate heap block, so that the address sanitizer detects an overrun
      EXPECT_EQ(encode_payload(message, small), 0u);
    }
  });
}

TEST(Messages, WhateverDecodesIsWhatAnEncoderWrites) {
  RandomMessages random(14);
  int accepted = 0;
  AllMessages::for_each([&](auto example) {
    using M = decltype(example);
    for (int i = 0; i < 5000; ++i) {
      Bytes payload = random.payload_of<M>();
      for (std::size_t flips = 1 + random.below(3); flips > 0 && !payload.empty(); --flips) {
        payload[random.below(payload.size())] ^= static_cast<std::uint8_t>(1u << random.below(8));
      }
      const auto message = decode_payload<M>(payload);
      if (!message) continue;
      ++accepted;
      Bytes again(kMaxPayload);
      again.resize(encode_payload(*message, again));
      ASSERT_EQ(again, payload) << name_of(M::kType);
    }
  });
  EXPECT_GT(accepted, 5000);
}

/// One hit, every field within its range.
Sweep possible_sweep() {
  Sweep sweep;
  sweep.flash_length_ticks = 3125;
  sweep.period_sixteenth_ticks = 13'333'333;
  sweep.station = 1;
  sweep.hits.push_back({31, 208, 300'001});
  return sweep;
}

TEST(SweepMessage, RefusesAStationOrReservedBitThatCannotBe) {
  Bytes out(kMaxPayload);
  Sweep sweep = possible_sweep();
  sweep.station = 2;
  EXPECT_EQ(encode_payload(sweep, out), 0u);
  out.resize(encode_payload(possible_sweep(), out));
  ASSERT_EQ(out.size(), 27u);
  out[18] |= 0x10;  // a reserved bit
  EXPECT_EQ(decode_payload<Sweep>(out).error(), DecodeError::kBadValue);
}

/// A field of a sweep: its offset in the payload, its size and its range.
struct RangedField {
  const char* name;
  std::size_t at;
  std::size_t bytes;
  std::int64_t minimum;
  std::int64_t maximum;
};

class SweepField : public ::testing::TestWithParam<RangedField> {};

TEST_P(SweepField, IsTakenWithinItsRangeAndRefusedOutsideOnBothEnds) {
  const RangedField& field = GetParam();
  Bytes payload(kMaxPayload);
  payload.resize(encode_payload(possible_sweep(), payload));
  const auto decodes_with = [&](std::int64_t value) {
    for (std::size_t i = 0; i < field.bytes; ++i) payload[field.at + i] = static_cast<std::uint8_t>(value >> (8 * i));
    return decode_payload<Sweep>(payload);
  };
  for (const std::int64_t inside : {field.minimum, field.maximum}) {
    const auto message = decodes_with(inside);
    ASSERT_TRUE(message.ok()) << inside;
    Bytes again(kMaxPayload);
    again.resize(encode_payload(*message, again));
    EXPECT_EQ(again, payload) << inside;
  }
  for (const std::int64_t outside : {field.minimum - 1, field.maximum + 1, std::int64_t{-1}}) {
    EXPECT_EQ(decodes_with(outside).error(), DecodeError::kBadValue) << outside;
  }
}

// The ranges of the byte table in proto/README.md.
INSTANTIATE_TEST_SUITE_P(ByteTable, SweepField,
                         ::testing::Values(RangedField{"flash_length", 8, 4, 2600, 7500},
                                           RangedField{"period", 12, 4, 13'200'000, 13'466'666},
                                           RangedField{"flash_sensors", 16, 1, 0, 32},
                                           RangedField{"sensor", 20, 1, 0, 31}, RangedField{"width", 21, 2, 16, 7500},
                                           RangedField{"centre", 23, 4, 0, 833'334}),
                         [](const auto& tested) { return tested.param.name; });

TEST(SweepMessage, IsNotWrittenWithAnImpossibleField) {
  const auto size_of = [](auto change) {
    Sweep sweep = possible_sweep();
    change(sweep);
    Bytes out(kMaxPayload);
    return encode_payload(sweep, out);
  };
  EXPECT_EQ(size_of([](Sweep&) {}), 27u);
  EXPECT_EQ(size_of([](Sweep& sweep) { sweep.flash_length_ticks = 0; }), 0u);
  EXPECT_EQ(size_of([](Sweep& sweep) { sweep.period_sixteenth_ticks = 0; }), 0u);
  EXPECT_EQ(size_of([](Sweep& sweep) { sweep.flash_sensors = 33; }), 0u);
  EXPECT_EQ(size_of([](Sweep& sweep) { sweep.hits[0].sensor = 32; }), 0u);
  EXPECT_EQ(size_of([](Sweep& sweep) { sweep.hits[0].width_ticks = 65'535; }), 0u);
  EXPECT_EQ(size_of([](Sweep& sweep) { sweep.hits[0].centre_half_ticks = -7; }), 0u);
}

TEST(PoseMessage, LetsNoNanThrough) {
  Bytes out(kMaxPayload);
  Pose pose;
  pose.answer.emplace();
  pose.answer->pose.position_m[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(encode_payload(pose, out), 0u);
  pose.answer->pose.position_m[1] = 0.0;
  const std::size_t size = encode_payload(pose, out);
  ASSERT_EQ(size, 14u + 56u + 84u + 12u + 1u);
  out.resize(size);
  ASSERT_TRUE(decode_payload<Pose>(out).ok());
  out[14 + 6] = 0xF0;  // the quaternion's w becomes infinite
  out[14 + 7] = 0x7F;
  EXPECT_EQ(decode_payload<Pose>(out).error(), DecodeError::kBadValue);
}

TEST(PoseMessage, HasAnAnswerExactlyWhenNotRefused) {
  Bytes out(kMaxPayload);
  Pose pose;
  EXPECT_EQ(encode_payload(pose, out), 0u);
  pose.refusal = 3;
  EXPECT_EQ(encode_payload(pose, out), 14u);
  pose.answer.emplace();
  EXPECT_EQ(encode_payload(pose, out), 0u);
}

TEST(Messages, RefuseTimesThatWouldOverflow) {
  Bytes out(kMaxPayload);
  EXPECT_EQ(encode_payload(Time{kMaxTicks}, out), 8u);
  EXPECT_EQ(encode_payload(Time{kMaxTicks + 1}, out), 0u);
  EXPECT_EQ(encode_payload(Time{-kMaxTicks - 1}, out), 0u);
  EXPECT_EQ(decode_payload<Time>(Bytes(8, 0x7F)).error(), DecodeError::kBadValue);
}

TEST(Text, IsCutAndCleanedAndRefusesBytesAfterItsEnd) {
  EXPECT_EQ(Text<4>("chaser").view(), "chas");
  EXPECT_EQ(Text<4>("a\nb").view(), "a?b");
  Text<4> text;
  const Bytes dirty{'a', 0, 'b', 0};
  ByteReader reader(dirty);
  read(reader, text);
  EXPECT_TRUE(reader.refused());
}

}  // namespace
}  // namespace pharos::wire
