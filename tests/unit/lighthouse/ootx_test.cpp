// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pharos/lighthouse/calibration_store.hpp"
#include "pharos/lighthouse/ootx_fields.hpp"
#include "pharos/lighthouse/ootx_frames.hpp"
#include "support/synthetic_light.hpp"

namespace pharos::lighthouse {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Payloads of four real stations, and the values of the first one.
constexpr const char* kStationBEC08E38 = "063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100";
constexpr const char* kStationC33B4DE1 = "063de14d3bc3002beb2b2e9dea202b09f89c39a0007f04f3ad48ba30a1b9a00200";
constexpr const char* kStationF77E21F3 = "066df3217ef7d9257327d7a005a00209bd1835180a7f073e3fb5bc472549a20100";
constexpr const char* kStation0AA54F65 = "066d654fa50a812bf52b801533050409d397669b007f02c8412526d81c1d9c0000";

class Frames : public ::testing::Test {
 protected:
  OotxFrames frames_;
  DecoderCounters counters_;
  std::vector<Bytes> got_;

  void push(const std::vector<bool>& bits, bool follows_last = true) {
    for (const bool bit : bits) {
      if (const auto payload = frames_.push(bit, follows_last, counters_)) {
        got_.emplace_back(payload->begin(), payload->end());
      }
      follows_last = true;
    }
  }
};

OotxPayload payload_of(const Bytes& bytes, std::uint8_t station = 0) {
  OotxPayload payload;
  payload.station = station;
  for (const std::uint8_t byte : bytes) payload.bytes.push_back(byte);
  return payload;
}

TEST_F(Frames, GiveThePayloadOfEachKnownStation) {
  for (const char* hex : {kStationBEC08E38, kStationC33B4DE1, kStationF77E21F3, kStation0AA54F65}) {
    got_.clear();
    const Bytes payload = test::from_hex(hex);
    ASSERT_EQ(test::ootx_bits(payload).size(), 358U);  // 3.0 s of one station's flashes
    push(test::ootx_bits(payload));
    ASSERT_EQ(got_.size(), 1U);
    EXPECT_EQ(got_[0], payload);
  }
  EXPECT_EQ(counters_.ootx_frames, 4U);
}

TEST_F(Frames, TakeEvenAndOddLengths) {
  for (std::size_t length = 1; length <= kMaxOotxPayload; ++length) {
    got_.clear();
    Bytes payload;
    for (std::size_t i = 0; i < length; ++i) payload.push_back(static_cast<std::uint8_t>(37 * i + length));
    push(test::ootx_bits(payload));
    ASSERT_EQ(got_.size(), 1U) << length;
    EXPECT_EQ(got_[0], payload);
  }
}

TEST_F(Frames, CutAnywhereTheNextFrameIsStillRead) {
  const std::vector<bool> frame = test::ootx_bits(test::from_hex(kStationBEC08E38));
  for (std::size_t cut = 1; cut < frame.size(); ++cut) {
    got_.clear();
    push({frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(cut)});
    push(frame);
    EXPECT_EQ(got_.size(), 1U) << "cut after " << cut << " bits";
  }
  EXPECT_EQ(counters_.ootx_bad_crc, 0U);
  EXPECT_GT(counters_.ootx_bad_sync, 300U);  // 17 zeros cannot miss a sync bit
}

TEST_F(Frames, AMissingBitEndsTheFrameAndNothingMore) {
  const std::vector<bool> frame = test::ootx_bits(test::from_hex(kStationBEC08E38));
  push({frame.begin(), frame.begin() + 100});
  push({frame.begin() + 101, frame.end()}, false);
  push(frame);
  EXPECT_EQ(got_.size(), 1U);
  EXPECT_EQ(counters_.ootx_restarts, 1U);
}

TEST_F(Frames, EverySingleWrongBitIsNoticed) {
  const std::vector<bool> frame = test::ootx_bits(test::from_hex(kStationC33B4DE1));
  // The padding byte of an odd length is not covered by the CRC and has no meaning.
  const std::size_t pad_begin = 18 + 17 * 17 + 8;
  for (std::size_t wrong = 0; wrong < frame.size(); ++wrong) {
    if (wrong >= pad_begin && wrong < pad_begin + 8) continue;
    got_.clear();
    std::vector<bool> bits = frame;
    bits[wrong] = !bits[wrong];
    push(bits);
    push(std::vector<bool>(1, true));
    // A wrong length may need more words than were received: a complete frame that follows ends that.
    EXPECT_TRUE(got_.empty()) << "bit " << wrong;
    push(frame);
    EXPECT_EQ(got_.size(), 1U) << "after bit " << wrong;
  }
  EXPECT_GT(counters_.ootx_bad_crc, 200U);
  EXPECT_GT(counters_.ootx_bad_sync, 15U);
  EXPECT_GT(counters_.ootx_bad_length, 5U);
}

TEST_F(Frames, ALengthOutOfRangeIsRefusedAtOnce) {
  std::vector<bool> bits(17, false);
  bits.push_back(true);
  bits.insert(bits.end(), 16, true);
  bits.push_back(true);
  push(bits);
  EXPECT_EQ(counters_.ootx_bad_length, 1U);
}

TEST_F(Frames, NoiseGivesNothing) {
  std::mt19937 random(1);
  std::bernoulli_distribution one(0.2);  // rich in preambles
  std::vector<bool> bits(200'000);
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = one(random);
  push(bits);
  EXPECT_TRUE(got_.empty());
  EXPECT_GT(counters_.ootx_bad_length + counters_.ootx_bad_sync, 100U);
}

TEST(OotxCrc, IsZlibs) {
  const Bytes check = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(ootx_crc(check.data(), check.size()), 0xCBF43926U);  // the published check value
}

TEST(Half, MatchesTheStandardsExamples) {
  EXPECT_EQ(half_to_double(0x0000), 0.0);
  EXPECT_TRUE(std::signbit(half_to_double(0x8000)));
  EXPECT_EQ(half_to_double(0x3C00), 1.0);
  EXPECT_EQ(half_to_double(0xC000), -2.0);
  EXPECT_EQ(half_to_double(0x7BFF), 65504.0);
  EXPECT_EQ(half_to_double(0x0400), std::ldexp(1.0, -14));
  EXPECT_EQ(half_to_double(0x0001), std::ldexp(1.0, -24));
  EXPECT_EQ(half_to_double(0x03FF), 1023 * std::ldexp(1.0, -24));
  EXPECT_TRUE(std::isinf(half_to_double(0x7C00)));
  EXPECT_TRUE(std::isinf(half_to_double(0xFC00)));
  EXPECT_TRUE(std::isnan(half_to_double(0x7C01)));
}

TEST(Fields, AreThoseOfTheWorkedPayload) {
  const Bytes bytes = test::from_hex(kStationBEC08E38);
  const auto fields = ootx_fields(bytes);
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->protocol, 6);
  EXPECT_EQ(fields->firmware, 0x3d06 >> 6);
  EXPECT_EQ(fields->calibration.id, 0xBEC08E38U);
  const RotorCalibration& x = fields->calibration[Axis::kX];
  const RotorCalibration& y = fields->calibration[Axis::kY];
  EXPECT_NEAR(x.phase_rad, 0.015587, 5e-7);
  EXPECT_NEAR(y.phase_rad, 0.038208, 5e-7);
  EXPECT_NEAR(x.tilt_rad, 0.000298, 5e-7);
  EXPECT_NEAR(y.tilt_rad, 0.002243, 5e-7);
  EXPECT_NEAR(x.curve_rad, -0.001802, 5e-7);
  EXPECT_NEAR(y.curve_rad, -0.001709, 5e-7);
  EXPECT_NEAR(x.gibbous_phase_rad, -0.32666, 5e-6);
  EXPECT_NEAR(y.gibbous_phase_rad, -1.50781, 5e-6);
  EXPECT_NEAR(x.gibbous_magnitude_rad, 0.00424957, 5e-9);
  EXPECT_NEAR(y.gibbous_magnitude_rad, -0.00576019, 5e-9);
  EXPECT_EQ(fields->mode, 1);
  EXPECT_EQ(fields->acceleration, (std::array<std::int8_t, 3>{-127, -3, 9}));
  EXPECT_EQ(fields->unlock_count, 2);
  EXPECT_EQ(fields->hardware, 9);
  EXPECT_EQ(fields->faults, 0);
}

TEST(Fields, RefuseWhatTheyCannotKnow) {
  Bytes bytes = test::from_hex(kStationBEC08E38);
  EXPECT_EQ(ootx_fields(std::span(bytes).first(30)).error(), OotxError::kTooShort);
  EXPECT_EQ(ootx_fields(std::span(bytes).first(31)).error(), OotxError::kTooShort);
  EXPECT_EQ(ootx_fields({}).error(), OotxError::kTooShort);
  bytes[0] = static_cast<std::uint8_t>((bytes[0] & 0xC0U) | 7U);
  EXPECT_EQ(ootx_fields(bytes).error(), OotxError::kUnknownProtocol);
  bytes[0] = static_cast<std::uint8_t>((bytes[0] & 0xC0U) | 5U);
  EXPECT_TRUE(ootx_fields(std::span(bytes).first(31)));
  for (const std::size_t at : {0x06U, 0x0CU, 0x12U, 0x17U, 0x1DU}) {
    Bytes broken = bytes;
    broken[at] = 0x00;
    broken[at + 1] = 0x7C;
    EXPECT_EQ(ootx_fields(broken).error(), OotxError::kNotFinite);
    broken[at] = 0x01;
    EXPECT_EQ(ootx_fields(broken).error(), OotxError::kNotFinite);
  }
}

TEST(CalibrationStore, UsesACalibrationOnlyWhenItCameTwice) {
  CalibrationStore store;
  const auto payload = payload_of(test::from_hex(kStationBEC08E38));
  EXPECT_EQ(store.push(payload), CalibrationStore::Verdict::kFirstTime);
  EXPECT_EQ(store.in_use(0), nullptr);
  EXPECT_EQ(store.push(payload), CalibrationStore::Verdict::kTakenIntoUse);
  ASSERT_NE(store.in_use(0), nullptr);
  EXPECT_EQ(store.in_use(1), nullptr);
  EXPECT_EQ(store.push(payload), CalibrationStore::Verdict::kUnchanged);
  EXPECT_EQ(store.accepted().size(), 1U);
}

TEST(CalibrationStore, NamesAStationFromItsFirstPayload) {
  CalibrationStore store;
  EXPECT_EQ(store.named_id(0), std::nullopt);
  store.push(payload_of(test::from_hex(kStationC33B4DE1)));
  EXPECT_EQ(store.named_id(0), 0xC33B4DE1U);
  store.push(payload_of(test::from_hex(kStationBEC08E38)));
  EXPECT_EQ(store.named_id(0), 0xBEC08E38U) << "the first one was false, or this one is: the next one tells";
  store.push(payload_of(test::from_hex(kStationBEC08E38)));
  store.push(payload_of(test::from_hex(kStationC33B4DE1)));
  EXPECT_EQ(store.named_id(0), 0xBEC08E38U) << "the one in use";
  EXPECT_EQ(store.named_id(1), std::nullopt);
  EXPECT_EQ(store.named_id(2), std::nullopt);
  store.forget_stations();
  EXPECT_EQ(store.named_id(0), std::nullopt);
}

TEST(CalibrationStore, AccelerationAndCountersDoNotMatter) {
  CalibrationStore store;
  Bytes bytes = test::from_hex(kStationBEC08E38);
  store.push(payload_of(bytes));
  bytes[0x0E] = 99;
  bytes[0x14] = 3;
  EXPECT_EQ(store.push(payload_of(bytes)), CalibrationStore::Verdict::kTakenIntoUse);
}

TEST(CalibrationStore, ASingleOtherPayloadChangesNothing) {
  CalibrationStore store;
  const Bytes good = test::from_hex(kStationBEC08E38);
  store.push(payload_of(good));
  store.push(payload_of(good));
  Bytes other = good;
  other[0x06] ^= 1U;  // phase0
  EXPECT_EQ(store.push(payload_of(other)), CalibrationStore::Verdict::kFirstTime);
  EXPECT_EQ(store.push(payload_of(good)), CalibrationStore::Verdict::kUnchanged);
  EXPECT_EQ(store.push(payload_of(other)), CalibrationStore::Verdict::kFirstTime) << "not twice in a row";
  EXPECT_EQ(store.in_use(0)->rotor[0], ootx_fields(good)->calibration.rotor[0]);
  EXPECT_EQ(store.push(payload_of(other)), CalibrationStore::Verdict::kTakenIntoUse);
  EXPECT_EQ(store.accepted().size(), 1U) << "one calibration an id: the newer one";
}

TEST(CalibrationStore, WhatWasAcceptedOnceIsAcceptedAtOnce) {
  const Bytes bytes = test::from_hex(kStationF77E21F3);
  CalibrationStore store;
  store.remember(ootx_fields(bytes)->calibration);
  EXPECT_EQ(store.in_use(0), nullptr);
  EXPECT_EQ(store.push(payload_of(bytes, 1)), CalibrationStore::Verdict::kTakenIntoUse);
  EXPECT_EQ(store.named_id(1), 0xF77E21F3U);
  store.forget_stations();
  EXPECT_EQ(store.in_use(1), nullptr);
  EXPECT_EQ(store.push(payload_of(bytes, 0)), CalibrationStore::Verdict::kTakenIntoUse);
}

TEST(CalibrationStore, AFullMemoryForgetsTheOldestThatIsNotInUse) {
  CalibrationStore store;
  const Bytes in_use = test::from_hex(kStationBEC08E38);
  store.push(payload_of(in_use));
  store.push(payload_of(in_use));
  StationCalibration other;
  for (std::uint32_t id = 1; id <= CalibrationStore::kMemory + 2; ++id) {
    other.id = id;
    store.remember(other);
  }
  EXPECT_EQ(store.accepted().size(), CalibrationStore::kMemory);
  EXPECT_EQ(store.accepted().front().id, 0xBEC08E38U);
  EXPECT_EQ(store.accepted().back().id, CalibrationStore::kMemory + 2);
}

TEST(CalibrationStore, UnreadablePayloadsChangeNothing) {
  CalibrationStore store;
  EXPECT_EQ(store.push(payload_of({1, 2, 3})), CalibrationStore::Verdict::kUnreadable);
  EXPECT_EQ(store.push(payload_of(test::from_hex(kStationBEC08E38), 2)), CalibrationStore::Verdict::kUnreadable);
}

}  // namespace
}  // namespace pharos::lighthouse
