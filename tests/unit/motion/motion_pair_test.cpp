// SPDX-License-Identifier: Apache-2.0
// Two stations that see one body: both in one estimate, compared with each of them alone on the same sweeps.
#include <gtest/gtest.h>

#include "pharos/geometry/symmetric.hpp"
#include "tests/unit/motion/flight.hpp"

namespace pharos::motion {
namespace {

using test::FlightScore;

// Two metres apart, directed towards the volume between them.
sim::LighthouseScenario before_two_stations(double duration_s, std::uint64_t seed, double speed_m_s = 0.5,
                                            double rate_deg_s = 60.0) {
  sim::LighthouseScenario scenario = test::manoeuvre(duration_s, speed_m_s, rate_deg_s, seed);
  scenario.stations.resize(2);
  scenario.stations[0].mode = sim::StationMode::kB;
  scenario.stations[1].mode = sim::StationMode::kC;
  scenario.stations[1].id = 2;
  scenario.stations[0].pose = {rotation_exp({0.0, 0.3, 0.0}), {-1.0, 0.0, 0.0}};
  scenario.stations[1].pose = {rotation_exp({0.0, -0.3, 0.0}), {1.0, 0.0, 0.0}};
  return scenario;
}

StationFromStation relative_of(const sim::LighthouseScenario& scenario) {
  return scenario.stations[0].pose.inverse() * scenario.stations[1].pose;
}

Matrix6 sigmas(double rotation_rad, double position_m) {
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>().setConstant(rotation_rad * rotation_rad);
  covariance.diagonal().tail<3>().setConstant(position_m * position_m);
  return covariance;
}

// Beyond five sigmas, and a degree or 20 mm.
bool far_off(const test::FlightSample& answer) {
  const auto& pose = answer.result->pose;
  if (!pose || pose->ambiguous()) return false;
  return answer.rotation_deg() > std::max(1.0, 5.0 * pose->sigma_rotation_rad() * kDegPerRad) ||
         answer.position_mm() > std::max(20.0, 5.0 * pose->sigma_position_m() * kMmPerM);
}

struct PairScore {
  std::array<FlightScore, kMaxStations> fused, alone;
  int far_off = 0;  // of the fused
  std::array<int, kMaxStations> rows_fused{};
};

class PairFlight {
 public:
  explicit PairFlight(const sim::LighthouseScenario& scenario, const MotionOptions& options = test::flight_options())
      : scenario_(scenario), options_(options) {}
  std::optional<StationRelative> relative;
  double settled_s = 2.0;  // results before are not counted
  std::function<void(lighthouse::Sweep&)> spoil = [](lighthouse::Sweep&) {};

  void run(std::uint64_t seed, PairScore& score) {
    sim::LighthouseSimulator simulator(scenario_, seed);
    const auto decoder = std::make_unique<lighthouse::Decoder>();
    std::array<std::unique_ptr<MotionTracker>, kMaxStations> alone;
    fused = std::make_unique<MotionTracker>(scenario_.target, options_);
    for (auto& tracker : alone) tracker = std::make_unique<MotionTracker>(scenario_.target, options_);
    for (std::uint8_t station = 0; station < kMaxStations; ++station) {
      fused->set_calibration(station, {});
      alone[station]->set_calibration(station, {});
    }
    fused->set_relative(relative);
    const auto take = [&](const std::optional<track::EpochResult>& result, auto& scores) {
      if (!result) return;
      const double time_s = ticks_to_seconds(result->time_ticks);
      if (time_s < 1.0 + settled_s) return;  // the counter starts at one second
      scores[result->station].add({time_s, &*result, simulator.truth(result->station, time_s)});
      if (&scores == &score.fused && far_off({time_s, &*result, simulator.truth(result->station, time_s)})) {
        ++score.far_off;
      }
      score.rows_fused[result->station] += (result->flags & track::kEpochFused) != 0 ? 1 : 0;
    };
    const auto give = [&] {
      while (decoder->take_ootx()) {
      }
      while (auto sweep = decoder->take_sweep()) {
        spoil(*sweep);
        take(fused->push(*sweep), score.fused);
        take(alone[sweep->flash.station]->push(*sweep), score.alone);
      }
    };
    while (const auto pulse = simulator.next()) {
      decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
      give();
    }
    decoder->flush();
    give();
  }

  std::unique_ptr<MotionTracker> fused;

 private:
  const sim::LighthouseScenario& scenario_;
  MotionOptions options_;
};

void print(const char* what, const PairScore& score) {
  for (std::size_t station = 0; station < kMaxStations; ++station) {
    for (const auto& [name, s] :
         {std::pair{"fused", &score.fused[station]}, std::pair{"alone", &score.alone[station]}}) {
      std::printf(
          "%s, station %zu %s: %.4f deg %.3f mm RMS, %.2f deg %.1f mm at most, NEES %.3f, %d answers (%d fused)\n",
          what, station, name, s->rotation_rms_deg(), s->position_rms_mm(), s->rotation_max_deg, s->position_max_mm,
          s->nees_per_freedom(), s->answers, score.rows_fused[station]);
    }
  }
}

void expect_consistent(const std::array<FlightScore, kMaxStations>& fused) {
  for (const FlightScore& score : fused) {
    EXPECT_GT(score.nees_per_freedom(), 0.9);
    EXPECT_LT(score.nees_per_freedom(), 1.1);
  }
}

TEST(MotionPair, WithAKnownRelativePoseBothAreBetterThanEitherAlone) {
  PairScore score;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const sim::LighthouseScenario scenario = before_two_stations(8.0, seed);
    PairFlight flight(scenario);
    // With the covariance of a calibration, and an error drawn from it.
    constexpr double kTurn_rad = 0.2e-3, kPlace_m = 0.3e-3;
    sim::RandomStream random(seed, "relative pose");
    Vector6 error;
    for (int k = 0; k < 6; ++k) error[k] = (k < 3 ? kTurn_rad : kPlace_m) * random.normal();
    flight.relative = {relative_of(scenario).moved_by(error), sigmas(kTurn_rad, kPlace_m)};
    flight.run(seed, score);
    EXPECT_FALSE(flight.fused->pair().survey_refused());
  }
  print("known", score);
  expect_consistent(score.fused);
  for (std::size_t station = 0; station < kMaxStations; ++station) {
    EXPECT_GT(score.fused[station].answers, 2500);
    EXPECT_LT(score.fused[station].rotation_rms_deg(), 0.9 * score.alone[station].rotation_rms_deg());
    EXPECT_LT(score.fused[station].position_rms_mm(), 0.9 * score.alone[station].position_rms_mm());
  }
}

TEST(MotionPair, LearnsWhereTheSecondStationStands) {
  PairScore score;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const sim::LighthouseScenario scenario = before_two_stations(8.0, seed);
    PairFlight flight(scenario);
    flight.run(seed, score);
    const auto relative = flight.fused->pair().relative();
    ASSERT_TRUE(relative.has_value()) << seed;
    const Vector6 error = pose_difference(relative_of(scenario), relative->T_0_1);
    EXPECT_LT(mahalanobis_squared<6>(error, relative->covariance), 30.0) << seed;  // six degrees of freedom
    EXPECT_LT(error.tail<3>().norm(), 0.02) << seed;
    EXPECT_LT(error.head<3>().norm(), 0.005) << seed;
  }
  print("learnt", score);
  expect_consistent(score.fused);
}

// Station 0 has seen four coplanar sensors alone, nearly from straight ahead, when both tracks are settled: 3.8 deg off
// at a stated 2. Learnt then, the relative pose was 2.4 deg off at a stated 0.5.
TEST(MotionPair, DoesNotLearnFromATiltThatIsNotKnown) {
  const sim::LighthouseScenario scenario = before_two_stations(4.0, 17154, 0.4, 40.0);
  PairScore score;
  PairFlight flight(scenario);
  flight.settled_s = 0.0;
  flight.run(17154, score);
  print("coplanar", score);
  EXPECT_EQ(score.far_off, 0);
  EXPECT_GT(score.fused[0].answers, 200);
}

// Every twentieth sweep of station 1 is 2 mm off. It opens the joint hypothesis, until those that follow tell that it
// was wrong: from there on it is as if it had never been. The stated variance of the position was five times a sound
// one's.
TEST(MotionPair, AWrongSweepDoesNotLeaveItOpen) {
  const sim::LighthouseScenario scenario = before_two_stations(4.0, 3, 0.4, 40.0);
  PairFlight flight(scenario);
  flight.relative = {relative_of(scenario), sigmas(0.2e-3, 0.3e-3)};
  PairScore sound, spoilt;
  flight.run(3, sound);
  int lit = 0;
  flight.spoil = [&lit](lighthouse::Sweep& sweep) {
    if (ticks_to_seconds(sweep.flash.start_ticks) < 3.0 || sweep.flash.station != 1 || sweep.hits.empty()) return;
    if (++lit % 20 != 0) return;
    for (lighthouse::Hit& hit : sweep.hits) hit.centre_half_ticks += 200;
  };
  flight.run(3, spoilt);
  EXPECT_GE(lit, 100);
  for (std::size_t station = 0; station < kMaxStations; ++station) {
    EXPECT_EQ(spoilt.fused[station].answers, sound.fused[station].answers);
    EXPECT_LT(spoilt.fused[station].sigma_position_square, 2.0 * sound.fused[station].sigma_position_square);
  }
}

// A wrong relative pose, or a station that was moved after the calibration.
TEST(MotionPair, AWrongRelativePoseIsRejectedReportedAndCostsNothing) {
  PairScore score;
  for (const double wrong_m : {0.02, 0.3}) {
    const sim::LighthouseScenario scenario = before_two_stations(8.0, 3);
    PairFlight flight(scenario);
    Vector6 error = Vector6::Zero();
    error[3] = wrong_m;
    flight.relative = {relative_of(scenario).moved_by(error), sigmas(0.2e-3, 0.3e-3)};
    flight.settled_s = 3.0;
    flight.run(3, score);
    EXPECT_TRUE(flight.fused->pair().survey_refused()) << wrong_m;
    EXPECT_GE(flight.fused->pair().refusals(), 1);
    // It is then estimated as if none had been given.
    const auto relative = flight.fused->pair().relative();
    ASSERT_TRUE(relative.has_value());
    EXPECT_LT((relative->T_0_1.t - relative_of(scenario).t).norm(), 0.02);
  }
  print("wrong", score);
  for (std::size_t station = 0; station < kMaxStations; ++station) {
    EXPECT_LT(score.fused[station].position_rms_mm(), score.alone[station].position_rms_mm());
    EXPECT_LT(score.fused[station].position_max_mm, 10.0);
  }
}

// One station is dark for two seconds, then the other: the body is never lost, and their estimated relative pose is
// kept.
TEST(MotionPair, GoesOnWithEitherStationAlone) {
  sim::LighthouseScenario scenario = before_two_stations(12.0, 5);
  scenario.faults.restarts = {{1, 4.0, 1.5}, {0, 8.0, 1.5}};
  PairScore score;
  PairFlight flight(scenario);
  flight.run(5, score);
  print("one dark", score);
  EXPECT_NE(flight.fused->pair().joint(), nullptr);
  EXPECT_EQ(flight.fused->pair().refusals(), 0);
  for (std::size_t station = 0; station < kMaxStations; ++station) {
    EXPECT_GT(score.fused[station].answers, 400);
    EXPECT_LT(score.fused[station].position_rms_mm(), score.alone[station].position_rms_mm());
    EXPECT_LT(score.fused[station].nees_per_freedom(), 1.6);
  }
}

// Three sensors of one station are too few for a start; with those of the other station they suffice.
TEST(MotionPair, AStationThatSeesTooLittleAloneIsHelpedByTheOther) {
  const sim::LighthouseScenario scenario = before_two_stations(6.0, 7);
  sim::LighthouseSimulator simulator(scenario, 7);
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  const auto fused = std::make_unique<MotionTracker>(scenario.target, test::flight_options());
  const auto alone = std::make_unique<MotionTracker>(scenario.target, test::flight_options());
  for (std::uint8_t station = 0; station < kMaxStations; ++station) {
    fused->set_calibration(station, {});
    alone->set_calibration(station, {});
  }
  fused->set_relative(StationRelative{relative_of(scenario), sigmas(0.2e-3, 0.3e-3)});
  int solved = 0, solved_alone = 0, asked = 0;
  double worst_mm = 0.0;
  while (const auto pulse = simulator.next()) {
    decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    while (decoder->take_ootx()) {
    }
    while (auto sweep = decoder->take_sweep()) {
      if (sweep->flash.station == 1) {
        while (sweep->hits.size() > 2) sweep->hits.pop_back();
      }
      const auto together = fused->push(*sweep), single = alone->push(*sweep);
      const double time_s = ticks_to_seconds(sweep->flash.start_ticks);
      if (sweep->flash.station != 1 || time_s < 3.0 || !together) continue;
      ++asked;
      if (single && single->pose) ++solved_alone;
      if (!together->pose) continue;
      ++solved;
      const auto truth = simulator.truth(1, ticks_to_seconds(together->time_ticks));
      worst_mm = std::max(worst_mm, (together->pose->pose.t - truth.t).norm() * kMmPerM);
    }
  }
  EXPECT_GT(asked, 150);
  EXPECT_EQ(solved_alone, 0);
  EXPECT_GT(solved, asked * 99 / 100);
  EXPECT_LT(worst_mm, 15.0);
}

// Two sensors alone are lit towards station 0, whose track drifts to 27 deg and 85 mm at a stated 12 and 17; station 1
// knows the body to 0.1 deg and 0.7 mm.
TEST(MotionPair, ATrackThatTheOtherStationContradictsIsNotAnswered) {
  const sim::LighthouseScenario scenario = before_two_stations(4.0, 17177, 1.2, 120.0);
  PairFlight flight(scenario);
  flight.settled_s = 0.0;
  flight.relative = {relative_of(scenario), sigmas(0.2e-3, 0.3e-3)};
  PairScore score;
  flight.run(17177, score);
  EXPECT_EQ(score.far_off, 0);
  EXPECT_GT(score.fused[0].answers + score.fused[1].answers, 430);
}

}  // namespace
}  // namespace pharos::motion
