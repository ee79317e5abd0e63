// SPDX-License-Identifier: Apache-2.0
// Which calibration is used for which station, and until when: with a tracker that only records its inputs.
#include "pharos/tracking/calibrated_tracker.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/synthetic_light.hpp"

namespace pharos::tracking {
namespace {

using lighthouse::OotxPayload;
using lighthouse::StationCalibration;
using lighthouse::Sweep;
using Verdict = lighthouse::CalibrationStore::Verdict;

constexpr std::uint32_t kFirstId = 0xBEC08E38, kSecondId = 0xC33B4DE1, kThirdId = 0x0AA54F65;

// The payload of a real station under another id; `variant` changes its calibration.
OotxPayload payload_of(std::uint8_t station, std::uint32_t id, std::uint8_t variant = 0) {
  auto bytes = test::from_hex("063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100");
  for (unsigned i = 0; i < 4; ++i) bytes[2 + i] = static_cast<std::uint8_t>(id >> 8 * i);
  bytes[6] = static_cast<std::uint8_t>(bytes[6] ^ variant);  // phase of rotor x
  OotxPayload payload;
  payload.station = station;
  for (const std::uint8_t byte : bytes) payload.bytes.push_back(byte);
  return payload;
}

StationCalibration known_calibration(std::uint32_t id) {
  StationCalibration calibration;
  calibration.id = id;
  calibration.rotor[0].phase_rad = 0.01;
  return calibration;
}

Sweep sweep_at(std::int64_t flash_ticks, std::uint8_t station = 0) {
  Sweep sweep;
  sweep.flash.station = station;
  sweep.flash.start_ticks = flash_ticks;
  return sweep;
}

/// Returns a result for every sweep at once and records the stations' calibrations.
class NotingTracker {
 public:
  void set_calibration(std::uint8_t station, const StationCalibration& calibration) { known[station] = calibration; }
  void clear_calibration(std::uint8_t station) { known[station].reset(); }
  void set_relative(const std::optional<motion::StationRelative>& value) { relative = value; }
  void forget_stations() {
    known = {};
    relative.reset();
    ++times_forgotten;
  }
  std::optional<track::EpochResult> push(const Sweep& sweep) {
    track::EpochResult result;
    result.station = sweep.flash.station;
    if (!known[sweep.flash.station]) result.flags = track::kEpochUncalibrated;
    return result;
  }
  std::optional<track::EpochResult> flush() { return std::nullopt; }

  std::array<std::optional<StationCalibration>, kMaxStations> known;
  std::optional<motion::StationRelative> relative;
  int times_forgotten = 0;
};

class StationKnowledge : public ::testing::Test {
 protected:
  using Tested = CalibratedTracker<NotingTracker>;

  static CalibrationPolicy by_survey(const StationSurvey& survey, bool use_sent) {
    CalibrationPolicy policy;
    policy.use_sent = use_sent;
    policy.survey = &survey;
    return policy;
  }
  static void push_twice(Tested& tracker, const OotxPayload& payload) {
    tracker.push(payload);
    tracker.push(payload);
  }
  static std::optional<std::uint32_t> id_at(const Tested& tracker, std::uint8_t station) {
    const auto& known = tracker.tracker().known[station];
    return known ? std::optional(known->id) : std::nullopt;
  }

  const std::array<KnownStation, 2> stations_{
      {{kFirstId, {}, known_calibration(kFirstId)}, {kSecondId, {}, known_calibration(kSecondId)}}};
  const CalibratedPair pair_{kFirstId, kSecondId, {Matrix3::Identity(), {1.0, 0.0, 0.0}}, Matrix6::Identity()};
  const StationSurvey survey_{stations_, &pair_};
};

TEST_F(StationKnowledge, ACalibrationThatIsSentHoldsFromItsSecondEqualPayload) {
  Tested tracker(CalibrationPolicy{});
  EXPECT_EQ(tracker.push(payload_of(0, kFirstId)), Verdict::kFirstTime);
  EXPECT_EQ(tracker.effective_calibration(0), nullptr);
  EXPECT_EQ(tracker.push(sweep_at(0))->flags, track::kEpochUncalibrated);
  EXPECT_EQ(tracker.push(payload_of(0, kFirstId)), Verdict::kTakenIntoUse);
  ASSERT_NE(tracker.effective_calibration(0), nullptr);
  EXPECT_EQ(tracker.tracker().known[0], *tracker.effective_calibration(0));
  EXPECT_EQ(tracker.push(sweep_at(1))->flags, 0);
  EXPECT_EQ(id_at(tracker, 1), std::nullopt);
}

TEST_F(StationKnowledge, OneFalsePayloadBetweenTwoGoodOnesChangesNothing) {
  Tested tracker(CalibrationPolicy{});
  tracker.push(payload_of(0, kFirstId));
  tracker.push(payload_of(0, kFirstId, 1));
  EXPECT_EQ(id_at(tracker, 0), std::nullopt) << "two payloads, but not equal";
  push_twice(tracker, payload_of(0, kFirstId));
  const StationCalibration held = *tracker.tracker().known[0];
  tracker.push(payload_of(0, kFirstId, 1));
  EXPECT_EQ(tracker.tracker().known[0], held);
  tracker.push(payload_of(0, kFirstId, 1));
  EXPECT_NE(tracker.tracker().known[0], held) << "now it came twice";
}

TEST_F(StationKnowledge, ARestartForgetsWhoStandsWhereAndNotWhatWasAccepted) {
  Tested tracker(CalibrationPolicy{});
  push_twice(tracker, payload_of(0, kFirstId));
  tracker.push(payload_of(1, kSecondId));
  tracker.restart();
  EXPECT_EQ(id_at(tracker, 0), std::nullopt);
  EXPECT_EQ(tracker.effective_calibration(0), nullptr);
  EXPECT_EQ(tracker.push(payload_of(1, kSecondId)), Verdict::kFirstTime) << "what waited is forgotten";
  EXPECT_EQ(tracker.push(payload_of(1, kFirstId)), Verdict::kTakenIntoUse) << "accepted before: once is enough";
  EXPECT_EQ(id_at(tracker, 1), kFirstId);
}

TEST_F(StationKnowledge, ALostLineForgetsTheBodyAndNotTheStations) {
  Tested tracker(CalibrationPolicy{});
  push_twice(tracker, payload_of(0, kFirstId));
  tracker.restart_tracking();
  EXPECT_EQ(tracker.tracker().times_forgotten, 1);
  EXPECT_EQ(id_at(tracker, 0), kFirstId);
}

TEST_F(StationKnowledge, WhatWasAcceptedInAnEarlierRunHoldsFromItsFirstPayload) {
  lighthouse::CalibrationStore before;
  before.push(payload_of(1, kFirstId));
  before.push(payload_of(1, kFirstId));
  Tested tracker(CalibrationPolicy{});
  tracker.resume(before);
  EXPECT_EQ(id_at(tracker, 1), kFirstId) << "read ahead: it is known where";
  before.forget_stations();
  tracker.resume(before);
  EXPECT_EQ(id_at(tracker, 1), std::nullopt);
  tracker.push(payload_of(0, kFirstId));
  EXPECT_EQ(id_at(tracker, 0), kFirstId);
}

TEST_F(StationKnowledge, EndsWith240SecondsWithoutAFlash) {
  Tested tracker(CalibrationPolicy{});
  push_twice(tracker, payload_of(0, kFirstId));
  std::int64_t ticks = 1'000;
  tracker.push(sweep_at(ticks));
  ticks += kMaxDarkness_ticks;
  EXPECT_EQ(tracker.push(sweep_at(ticks, 1))->station, 1);
  EXPECT_EQ(tracker.push(sweep_at(ticks))->flags, 0) << "not longer than that";
  ticks += kMaxDarkness_ticks + 1;
  EXPECT_EQ(tracker.push(sweep_at(ticks))->flags, track::kEpochUncalibrated);
  EXPECT_EQ(tracker.effective_calibration(0), nullptr);
}

// The board's clock may have run for hours before the first sweep: payloads received before the first flash are not
// old.
TEST_F(StationKnowledge, TheFirstFlashEndsNoDarknessHoweverLateItIs) {
  Tested tracker(CalibrationPolicy{});
  push_twice(tracker, payload_of(0, kFirstId));
  EXPECT_EQ(tracker.push(sweep_at(10 * kMaxDarkness_ticks))->flags, 0);
  tracker.restart();
  push_twice(tracker, payload_of(0, kFirstId));
  EXPECT_EQ(tracker.push(sweep_at(30 * kMaxDarkness_ticks))->flags, 0);
  EXPECT_EQ(tracker.tracker().times_forgotten, 1);
}

TEST_F(StationKnowledge, ALateOrFalseFlashIsNoDarkness) {
  Tested tracker(CalibrationPolicy{});
  push_twice(tracker, payload_of(0, kFirstId));
  tracker.push(sweep_at(2 * kMaxDarkness_ticks));
  tracker.push(sweep_at(0));  // out of order
  EXPECT_EQ(tracker.push(sweep_at(3 * kMaxDarkness_ticks))->flags, 0);
  EXPECT_FALSE(tracker.push(sweep_at(9 * kMaxDarkness_ticks, kMaxStations))) << "of no station";
  EXPECT_EQ(tracker.push(sweep_at(3 * kMaxDarkness_ticks + 1))->flags, 0);
}

TEST_F(StationKnowledge, DarknessIsMeasuredAcrossALostLine) {
  Tested tracker(CalibrationPolicy{});
  push_twice(tracker, payload_of(0, kFirstId));
  tracker.push(sweep_at(0));
  tracker.restart_tracking();
  EXPECT_EQ(tracker.push(sweep_at(kMaxDarkness_ticks + 1))->flags, track::kEpochUncalibrated);
}

// A soft core skips such sweeps. The station that it solves must not be forgotten while the other one flashes.
TEST_F(StationKnowledge, AStationThatIsNotAnsweredIsLightAllTheSame) {
  CalibrationPolicy policy;
  policy.answer_uncalibrated = false;
  Tested tracker(policy);
  push_twice(tracker, payload_of(0, kFirstId));
  EXPECT_TRUE(tracker.push(sweep_at(0)));
  for (int i = 1; i <= 4; ++i) EXPECT_FALSE(tracker.push(sweep_at(i * kMaxDarkness_ticks, 1)));
  EXPECT_TRUE(tracker.push(sweep_at(5 * kMaxDarkness_ticks)));
  // And darkness is detected although no sweep was ever solved.
  tracker.restart();
  tracker.push(payload_of(1, kSecondId));
  tracker.push(sweep_at(0, 1));
  tracker.push(sweep_at(kMaxDarkness_ticks + 1, 1));
  EXPECT_EQ(tracker.push(payload_of(1, kSecondId)), Verdict::kFirstTime);
}

TEST_F(StationKnowledge, TheSurveyGoesBeforeWhatAStationSends) {
  Tested tracker(by_survey(survey_, true));
  EXPECT_EQ(id_at(tracker, 0), std::nullopt);
  tracker.push(payload_of(0, kFirstId));
  EXPECT_EQ(tracker.tracker().known[0], known_calibration(kFirstId)) << "its name is enough";
  tracker.push(payload_of(0, kFirstId));
  EXPECT_EQ(tracker.tracker().known[0], known_calibration(kFirstId));
  EXPECT_NE(*tracker.sent().in_use(0), known_calibration(kFirstId));
  push_twice(tracker, payload_of(1, kThirdId));
  EXPECT_EQ(tracker.effective_calibration(1), tracker.sent().in_use(1)) << "a station that the survey does not know";
}

TEST_F(StationKnowledge, TheSurveyAloneLeavesOtherStationsUncalibrated) {
  Tested tracker(by_survey(survey_, false));
  push_twice(tracker, payload_of(0, kThirdId));
  EXPECT_EQ(id_at(tracker, 0), std::nullopt);
  push_twice(tracker, payload_of(0, kSecondId));
  EXPECT_EQ(id_at(tracker, 0), kSecondId);
  push_twice(tracker, payload_of(0, kThirdId));
  EXPECT_EQ(id_at(tracker, 0), std::nullopt) << "what held for the station before does not hold for this one";
}

TEST_F(StationKnowledge, AStationKnownByItsSlotHoldsAtOnceAndThroughARestart) {
  const std::array<KnownStation, 2> by_slot{
      {{kFirstId, {}, known_calibration(kFirstId)}, {{}, 1, known_calibration(7)}}};
  const StationSurvey survey{by_slot, nullptr};
  Tested tracker(by_survey(survey, false));
  EXPECT_EQ(id_at(tracker, 1), 7u);
  push_twice(tracker, payload_of(1, kFirstId));
  EXPECT_EQ(id_at(tracker, 1), 7u) << "slot before name";
  tracker.restart();
  EXPECT_EQ(id_at(tracker, 1), 7u);
}

TEST_F(StationKnowledge, NoneHoldsWhereThePolicyAsksForNone) {
  CalibrationPolicy policy;
  policy.use_sent = false;
  Tested tracker(policy);
  push_twice(tracker, payload_of(0, kFirstId));
  EXPECT_EQ(id_at(tracker, 0), std::nullopt);
  EXPECT_EQ(tracker.sent().named_id(0), kFirstId) << "but it has a name";
}

TEST_F(StationKnowledge, TheRelativePoseHoldsForThePairThatWasMeasuredAndNoOther) {
  Tested tracker(by_survey(survey_, true));
  tracker.push(payload_of(0, kFirstId));
  EXPECT_FALSE(tracker.tracker().relative);
  tracker.push(payload_of(1, kSecondId));
  ASSERT_TRUE(tracker.tracker().relative);
  EXPECT_EQ(tracker.tracker().relative->T_0_1.t[0], 1.0);
  tracker.restart_tracking();
  EXPECT_TRUE(tracker.tracker().relative) << "told again";
  // Another station in slot 1 has another pose.
  push_twice(tracker, payload_of(1, kThirdId));
  EXPECT_FALSE(tracker.tracker().relative);
  // With exchanged slots it is the inverse.
  tracker.restart();
  EXPECT_FALSE(tracker.tracker().relative);
  tracker.push(payload_of(1, kFirstId));
  tracker.push(payload_of(0, kSecondId));
  ASSERT_TRUE(tracker.tracker().relative);
  EXPECT_EQ(tracker.tracker().relative->T_0_1.t[0], -1.0);
}

}  // namespace
}  // namespace pharos::tracking
