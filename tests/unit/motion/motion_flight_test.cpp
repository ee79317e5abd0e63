// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cmath>

#include "pharos/geometry/symmetric.hpp"
#include "tests/unit/motion/flight.hpp"

namespace pharos::motion {
namespace {

using test::FlightSample;
using test::FlightScore;

// Twelve short manoeuvres, four at each of three speeds.
TEST(MotionFlight, CovarianceIsConsistentOverManoeuvres) {
  FlightScore all;
  std::uint64_t seed = 1;
  for (const double pace : {1.0, 2.0, 3.0}) {
    for (int run = 0; run < 4; ++run, ++seed) {
      test::fly(test::manoeuvre(8.0, 0.5 * pace, 60.0 * pace, seed), seed,
                [&](const FlightSample& answer) { all.add(answer); });
    }
  }
  EXPECT_GT(all.answers, 10'000);
  // Few and correlated results: twice the campaign's interval.
  EXPECT_GT(all.nees_per_freedom(), 0.8);
  EXPECT_LT(all.nees_per_freedom(), 1.2);
}

TEST(MotionFlight, AtRestItIsTwiceAsGoodAsOneCycleAfterAFifthOfASecond) {
  constexpr double kSettled_s = 0.2;
  double rotation = 0.0, position = 0.0, bound_rotation = 0.0, bound_position = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const sim::LighthouseScenario scenario = test::still(0.6, 3.0, seed);
    double first_s = -1.0;
    bool taken = false;
    test::fly(scenario, seed, [&](const FlightSample& answer) {
      if (taken || !answer.result->pose || answer.result->pose->ambiguous()) return;
      if (first_s < 0.0) first_s = answer.time_s;
      if (answer.time_s < first_s + kSettled_s) return;
      taken = true;
      rotation += std::pow(answer.rotation_deg(), 2);
      position += std::pow(answer.position_mm(), 2);
      const auto seen = pose::visible_sensors(scenario.target, answer.truth, pose::kVisibleIncidence_rad);
      const auto precision = pose::precision_of(scenario.target, answer.truth, seen, kPaperRho);
      ASSERT_TRUE(precision.ok());
      bound_rotation += std::pow(precision->adop_deg_per_rad * kPaperSigma_rad, 2);
      bound_position += std::pow(precision->pdop_m_per_rad * kPaperSigma_rad * kMmPerM, 2);
    });
    EXPECT_TRUE(taken) << "seed " << seed;
  }
  EXPECT_LT(std::sqrt(rotation / bound_rotation), 0.5);
  EXPECT_LT(std::sqrt(position / bound_position), 0.5);
}

TEST(MotionFlight, StationaryItNeitherDriftsNorBecomesOverconfident) {
  double late_square = 0.0, nees = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    test::fly(test::still(20.0, 2.0, seed), seed, [&](const FlightSample& answer) {
      if (answer.time_s < 11.0 || !answer.result->pose) return;
      late_square += std::pow(answer.position_mm(), 2);
      nees += answer.nees() / 6.0;
      ++count;
    });
  }
  ASSERT_GT(count, 3000);
  EXPECT_LT(std::sqrt(late_square / count), 0.1);  // mm, ten seconds on
  EXPECT_LT(nees / count, 2.0);                    // three stationary poses: three correlated samples
}

TEST(MotionFlight, ComesBackAfterDarkness) {
  sim::LighthouseScenario scenario = test::manoeuvre(12.0, 1.0, 120.0, 5);
  scenario.faults.blackouts = {{3.0, 3.15}, {6.0, 7.5}};
  FlightScore all;
  double last_before_s = 0.0, first_after_s = 0.0;
  test::fly(scenario, 5, [&](const FlightSample& answer) {
    all.add(answer);
    const double time_s = answer.time_s - 1.0;  // the counter starts at one second
    if (!answer.result->pose) return;
    if (time_s < 6.0) last_before_s = time_s;
    if (time_s > 7.5 && first_after_s == 0.0) first_after_s = time_s;
  });
  EXPECT_GT(last_before_s, 5.9);
  EXPECT_LT(first_after_s, 7.75);  // the decoder locks again, then one cycle
  EXPECT_LT(all.nees_per_freedom(), 1.2);
  EXPECT_LT(all.rotation_max_deg, 3.0);
}

// For four seconds one sensor receives only reflected light, another receives both, the reflection stronger.
TEST(MotionFlight, LeavesReflectionsOutHoweverStrong) {
  const auto corrupt = [](lighthouse::Sweep& sweep) {
    const double time_s = ticks_to_seconds(sweep.flash.start_ticks);
    if (time_s < 3.0 || time_s > 7.0) return;
    const std::size_t hits = sweep.hits.size();
    for (std::size_t i = 0; i < hits; ++i) {
      lighthouse::Hit& hit = sweep.hits[i];
      if (hit.sensor == 0) hit.centre_half_ticks += 2 * 866;
      if (hit.sensor == 3) {
        lighthouse::Hit second = hit;
        second.centre_half_ticks -= 2 * 600;
        second.width_ticks = static_cast<std::uint16_t>(2 * hit.width_ticks);
        sweep.hits.push_back(second);
      }
    }
  };
  FlightScore all;
  test::fly(
      test::manoeuvre(8.0, 0.5, 60.0, 9), 9, [&](const FlightSample& answer) { all.add(answer); }, corrupt);
  EXPECT_GT(all.answers, 900);
  EXPECT_LT(all.position_rms_mm(), 1.0);
  EXPECT_LT(all.rotation_rms_deg(), 0.1);
}

TEST(MotionFlight, GoesOnWhenHalfOfTheSensorsDie) {
  FlightScore all;
  test::fly(
      test::still(8.0, 2.0, 4, 8), 4, [&](const FlightSample& answer) { all.add(answer); },
      [](lighthouse::Sweep& sweep) {
        if (ticks_to_seconds(sweep.flash.start_ticks) < 4.0) return;
        for (std::size_t i = sweep.hits.size(); i-- > 0;) {
          if (sweep.hits[i].sensor % 2 == 1) sweep.hits.erase_unordered(i);
        }
      });
  EXPECT_GT(all.answers, 850);
  EXPECT_LT(all.position_max_mm, 3.0);
}

// The station is off for a second and a half and continues with other rotor phases.
TEST(MotionFlight, ARestartInFlightCostsTheDarknessAndNoMore) {
  sim::LighthouseScenario scenario = test::manoeuvre(9.0, 0.5, 60.0, 6);
  scenario.faults.restarts = {{0, 4.0, 1.5}};
  FlightScore all, settled;
  double last_before_s = 0.0, first_after_s = 0.0, max_sigmas = 0.0;
  test::fly(scenario, 6, [&](const FlightSample& answer) {
    all.add(answer);
    const double time_s = answer.time_s - 1.0;  // the counter starts at one second
    if (!answer.result->pose) return;
    if (time_s < 4.0) last_before_s = time_s;
    if (time_s > 5.5 && first_after_s == 0.0) first_after_s = time_s;
    if (first_after_s == 0.0 || time_s > first_after_s + 0.1) settled.add(answer);
    const double variance = answer.result->pose.value().covariance.bottomRightCorner<3, 3>().trace();
    max_sigmas = std::max(max_sigmas, answer.position_mm() / 1e3 / std::sqrt(variance));
  });
  EXPECT_GT(last_before_s, 3.9);
  EXPECT_GT(first_after_s, 5.5);
  EXPECT_LT(first_after_s, 6.5);
  EXPECT_GT(all.answers, 750);
  EXPECT_LT(settled.position_max_mm, 10.0);
  // The first tenth of a second knows it to a centimetre (sum of three sigmas squared), and says so.
  EXPECT_LT(max_sigmas, 3.0);
  EXPECT_LT(all.nees_per_freedom(), 1.2);
}

// Stations are distinguished by their slot: with one identity twice both still have poses.
TEST(MotionFlight, TwoStationsOfOneIdentityKeepTheirOwnPoses) {
  sim::LighthouseScenario scenario = test::still(4.0, 2.0, 11, 8);
  scenario.stations.resize(2);
  scenario.stations[0].mode = sim::StationMode::kB;
  scenario.stations[1].mode = sim::StationMode::kC;
  scenario.stations[1].id = scenario.stations[0].id;
  scenario.stations[1].pose.t = {0.4, 0.1, 0.1};
  std::array<int, kMaxStations> good{};
  test::fly(scenario, 11, [&](const FlightSample& answer) {
    if (answer.time_s < 2.0 || !answer.result->pose || answer.result->pose->ambiguous()) return;
    EXPECT_LT(answer.position_mm(), 10.0) << "station " << int{answer.result->station};
    ++good[answer.result->station];
  });
  EXPECT_GT(good[0], 100);
  EXPECT_GT(good[1], 100);
}

// Sensors and rotors with the workshop errors, and no calibration: the known systematic errors are in the covariance.
TEST(MotionFlight, CovarianceIncludesTheGivenSystematicErrors) {
  MotionOptions options = test::flight_options();
  options.systematic = kUncalibratedErrors;
  FlightScore silent, with_systematics;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    sim::LighthouseScenario scenario = test::manoeuvre(6.0, 0.5, 60.0, seed);
    scenario.errors = sim::ErrorScenario::workshop();
    const auto none = [](lighthouse::Sweep&) {};
    test::fly(
        scenario, seed, [&](const FlightSample& answer) { silent.add(answer); }, none);
    test::fly(
        scenario, seed, [&](const FlightSample& answer) { with_systematics.add(answer); }, none, options);
  }
  EXPECT_GT(silent.nees_per_freedom(), 4.0);
  EXPECT_LT(with_systematics.nees_per_freedom(), 2.0);  // six samples of the errors
}

TEST(MotionFlight, AStationThatComesBackWithAnotherCalibrationIsLookedForAnew) {
  const Target target = test::frustum_target();
  MotionTracker tracker(target, {});
  lighthouse::StationCalibration first, second;
  first.id = 1;
  second.id = 1;
  second.rotor[0].phase_rad = 0.03;
  tracker.set_calibration(0, first);
  EXPECT_FALSE(tracker.predicted(0, 0).has_value());
  const sim::LighthouseScenario scenario = test::still(1.0, 2.0, 2);
  sim::LighthouseSimulator simulator(scenario, 2);
  lighthouse::Decoder decoder;
  std::int64_t last_ticks = 0;
  while (const auto pulse = simulator.next()) {
    decoder.push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    while (decoder.take_ootx()) {
    }
    while (const auto sweep = decoder.take_sweep()) {
      last_ticks = sweep->flash.start_ticks;
      tracker.push(*sweep);
    }
  }
  ASSERT_TRUE(tracker.predicted(0, last_ticks).has_value());
  tracker.set_calibration(0, first);  // the same calibration again changes nothing
  ASSERT_TRUE(tracker.predicted(0, last_ticks).has_value());
  tracker.set_calibration(0, second);
  EXPECT_FALSE(tracker.predicted(0, last_ticks).has_value());
}

// The target is shaken by hand at 3 to 5 Hz: 30 rad/s and 2.5 m/s, reversed within four cycles of the station.
TEST(MotionFlight, AShakenBodyIsKnownAsWellAsItSays) {
  test::FlightScore score;
  int refused = 0;  // after the first answer: a start in the middle of it takes up to 25 sweeps
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    int sweeps = 0, first = 0;
    sim::LighthouseScenario scenario = test::flight_scenario(6.0);
    sim::RandomStream random(seed, "hand");
    std::array<sim::Sine, 3> shift, turn;
    for (std::size_t k = 0; k < 3; ++k) {
      shift[k] = {0.08, random.uniform(3.0, 5.0), random.uniform(0.0, kTwoPi)};
      turn[k] = {k == 2 ? 0.9 : 0.35, random.uniform(3.0, 5.0), random.uniform(0.0, kTwoPi)};
    }
    const sim::RoomFromBody centre{rotation_exp({kPi - 0.3, 0.0, 0.0}), {0.0, 0.0, 2.0}};
    scenario.trajectory = std::make_shared<sim::SineTrajectory>(centre, shift, turn, 0.0);
    test::fly(scenario, seed, [&](const test::FlightSample& answer) {
      ++sweeps;
      if (first == 0 && answer.result->pose) first = sweeps;
      refused += first > 0 && !answer.result->pose ? 1 : 0;
      score.add(answer);
    });
    EXPECT_LT(first, 25);
  }
  std::printf("shaken: NEES %.3f, RMS %.3f deg %.3f mm, max %.2f deg %.1f mm, %d answers, %d refused\n",
              score.nees_per_freedom(), score.rotation_rms_deg(), score.position_rms_mm(), score.rotation_max_deg,
              score.position_max_mm, score.answers, refused);
  EXPECT_LT(score.nees_per_freedom(), 1.1);
  EXPECT_LT(score.position_rms_mm(), 3.0);
  EXPECT_LT(refused, score.answers / 100);
}

// Largest stated rotation of the third to tenth answer from a sweep on that has six sensors and more, a second after
// the start, and whose hits are all shifted by so much.
double stated_after_rad(std::uint64_t seed, std::int32_t shift_half_ticks) {
  constexpr double kSpoiled_s = 2.0;  // the counter starts at one second
  int answers = -1;
  double worst_rad = 0.0;
  test::fly(
      test::manoeuvre(1.3, 0.4, 40.0, seed), seed,
      [&](const test::FlightSample& answer) {
        if (answers >= 0) ++answers;
        if (answers < 3 || answers > 10) return;
        ASSERT_TRUE(answer.result->pose) << seed;
        worst_rad = std::max(worst_rad, answer.result->pose->sigma_rotation_rad());
      },
      [&](lighthouse::Sweep& sweep) {
        if (answers >= 0 || ticks_to_seconds(sweep.flash.start_ticks) < kSpoiled_s || sweep.hits.size() < 6) return;
        answers = 0;
        for (lighthouse::Hit& hit : sweep.hits) hit.centre_half_ticks += shift_half_ticks;
      });
  return worst_rad;
}

// Taken for a push it left the filter open for tens of sweeps: wide gates, rates that are not the body's, and the next
// wrong sweep was followed. The sweeps after it show that there was no push.
TEST(MotionFlight, ASweepThatIsAMillimetreOffDoesNotOpenTheFilter) {
  constexpr std::int32_t kHalfMilliradian_half_ticks = 120;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double sound_rad = stated_after_rad(seed, 0);
    for (const std::int32_t shift : {-kHalfMilliradian_half_ticks, kHalfMilliradian_half_ticks}) {
      EXPECT_LT(stated_after_rad(seed, shift), 1.3 * sound_rad) << seed;
    }
  }
}

TEST(MotionFlight, PredictsAheadWithGrowingCovarianceAndThenNotAtAll) {
  const sim::LighthouseScenario scenario = test::manoeuvre(3.0, 0.5, 60.0, 3);
  sim::LighthouseSimulator simulator(scenario, 3);
  lighthouse::Decoder decoder;
  MotionOptions options;
  options.smooth_flashes = false;
  MotionTracker tracker(scenario.target, options);
  tracker.set_calibration(0, {});
  std::int64_t last_ticks = 0;
  while (const auto pulse = simulator.next()) {
    decoder.push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    while (decoder.take_ootx()) {
    }
    while (const auto sweep = decoder.take_sweep()) {
      if (const auto result = tracker.push(*sweep)) last_ticks = result->time_ticks;
    }
  }
  const auto after = [&](double ahead_s) {
    return tracker.predicted(0, last_ticks + static_cast<std::int64_t>(ahead_s * kTicksPerSecond));
  };
  const auto now = after(0.0), soon = after(0.05), later = after(0.2);
  ASSERT_TRUE(now && soon && later);
  EXPECT_LT(now->covariance.trace(), soon->covariance.trace());
  EXPECT_LT(soon->covariance.trace(), later->covariance.trace());
  const LighthouseFromBody truth = simulator.truth(0, ticks_to_seconds(last_ticks) + 0.05);
  const Vector6 error = pose_difference(truth, soon->pose);
  EXPECT_LT(mahalanobis_squared<6>(error, soon->covariance), 30.0);  // six degrees of freedom
  EXPECT_FALSE(after(MotionTracker::kLost_s + 0.01).has_value());
}

}  // namespace
}  // namespace pharos::motion
