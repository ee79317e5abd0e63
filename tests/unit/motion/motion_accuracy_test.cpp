// SPDX-License-Identifier: Apache-2.0
// Paper 002, section 4.3 and table 2, with the systematic errors called workshop: ten manoeuvres of a minute, each
// calibrated from thirty poses of two seconds and one length known to 0.02 mm. Four columns: each cycle alone or
// motion-aware, with OOTX alone or calibrated. The body frame is that of the assumed sensor positions, as a hand-eye
// calibration with a motion-capture system would find it; the station's frame is given.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "host/calibrate/calibration_file.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tests/unit/motion/flight.hpp"
#include "tools/sim/body_frame.hpp"
#include "unit/host/calibrate/simulated_session.hpp"

namespace pharos::motion {
namespace {

// Results from here on: after a start from one cycle the rates are unknown.
constexpr double kSettled_s = 1.5;  // the counter starts at one second
// Sensors of the target's top plate: with these alone a tilt is weakly observable.
constexpr int kPlate = 4;
// Stated sigmas whose 2.5- and 3-fold are half a degree and 6 mm.
constexpr UncertaintyLimits kGoodEnough{0.2 * kRadPerDeg, 2e-3};

struct Known {
  Target target;
  lighthouse::StationCalibration station;
  SystematicErrors systematic;
  double scale_sigma = 0.0;
};

lighthouse::StationCalibration station_of(const std::array<sim::SheetErrors, 2>& errors) {
  lighthouse::StationCalibration station;
  station.id = 1;
  for (std::size_t k = 0; k < kAxes; ++k) {
    station.rotor[k] = {errors[k].phase_rad, errors[k].tilt_rad, errors[k].curve_rad, errors[k].gibbous_phase_rad,
                        errors[k].gibbous_magnitude_rad};
  }
  return station;
}

class Flight {
 public:
  explicit Flight(std::uint64_t seed) : simulator_(scenario_of(seed), seed) {
    const auto decoder = std::make_unique<lighthouse::Decoder>();
    const auto take = [&] {
      while (const auto sweep = decoder->take_sweep()) sweeps_.push_back(*sweep);
      while (decoder->take_ootx()) {
      }
    };
    while (const auto pulse = simulator_.next()) {
      decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
      take();
    }
    decoder->flush();
    take();
    calibrate::test::Session session;
    session.seed = seed;  // the same errors
    sim::LighthouseSimulator stills(calibrate::test::scenario_of(session), seed);
    const auto calibration = calibrate::calibrate_lighthouse(calibrate::test::calibration_input(stills, seed));
    nominal_ = {simulator_.nominal_target(), station_of(simulator_.stations()[0].announced.rotor), kUncalibratedErrors};
    // Through the file, as for a user.
    const auto file =
        calibrate::parse_calibration(calibrate::calibration_text(calibration, simulator_.nominal_target()), "flight");
    calibrated_ = {calibrate::calibrated_target(file, simulator_.nominal_target()), file.stations.front().calibration,
                   calibrate::systematic_errors(file), file.scale_sigma};
  }

  const Known& assumptions(bool calibrated) const { return calibrated ? calibrated_ : nominal_; }

  template <class Tracker>
  void track(Tracker& tracker, bool calibrated, double from_s, test::FlightScore& all,
             test::FlightScore& seen_well) const {
    const auto T_true_assumed = sim::body_frame_of(assumptions(calibrated).target, simulator_.true_target());
    tracker.set_calibration(0, assumptions(calibrated).station);
    for (const lighthouse::Sweep& sweep : sweeps_) {
      auto result = tracker.push(sweep);
      if (!result) continue;
      if (result->pose) calibrate::widen_by_scale(result->pose.value(), assumptions(calibrated).scale_sigma);
      const double time_s = ticks_to_seconds(result->time_ticks);
      if (time_s < from_s) continue;
      const test::FlightSample answer{time_s, &*result, simulator_.truth(0, time_s) * T_true_assumed};
      all.add(answer);
      if (sweep.hits.size() > kPlate) seen_well.add(answer);
    }
  }

  // Only the Kalman filter's covariance: linearised at the truth, with known target, station and jerk of the flight.
  // `take` gets the sigma of the attitude (square root of the trace) after every sweep.
  template <class Take>
  void covariance_at_the_truth(Take&& take) const {
    // White jerk, rad^2/s^5 and m^2/s^5: a third of that of the tracker's moving model with the lowest jerk.
    constexpr double kTurning = 3e-4, kMoving = 1e-4, kDelta_s = 1e-3;
    const lighthouse::StationCalibration station = station_of(simulator_.stations()[0].true_errors);
    const StationView view{&simulator_.true_target(), &station};
    const SweepNoise noise{kPaperSigma_rad * std::sqrt(1.0 - kPaperRho), kPaperSigma_rad * std::sqrt(kPaperRho)};
    MovingState state;
    state.pp.diagonal() << Vector3::Constant(4e-3), Vector3::Constant(1e-2);
    state.rr = state.aa = Matrix6::Identity();
    std::int64_t before_ticks = 0;
    for (const lighthouse::Sweep& sweep : sweeps_) {
      lighthouse::SweepBearings bearings = lighthouse::bearings_of(sweep);
      for (lighthouse::Bearing& bearing : bearings) bearing.width_ticks = 0;  // the noise here does not depend on it
      const std::int64_t now_ticks = last_hit_ticks(bearings, simulator_.true_target());
      if (now_ticks == INT64_MIN) continue;
      const double now_s = ticks_to_seconds(now_ticks);
      if (before_ticks != 0) state.predict(ticks_to_seconds(now_ticks - before_ticks), kTurning, kMoving);
      before_ticks = now_ticks;
      StateEstimate truth;
      truth.pose = simulator_.truth(0, now_s);
      truth.rate = pose_difference(simulator_.truth(0, now_s + kDelta_s), truth.pose) / kDelta_s;
      truth.covariance = truth.gate_covariance = state.pp;
      const SweepFit fit = fit_sweep(bearings, sweep.flash.axis, view, truth, now_ticks, noise);
      state.correct(fit.information, innovation_of(fit.information, state.pp, Vector6::Zero()), false);
      state.pose = truth.pose;
      state.rate = truth.rate;
      state.acceleration.setZero();
      if (now_s > kSettled_s) take(std::sqrt(state.pp.topLeftCorner<3, 3>().trace()));
    }
  }

 private:
  static sim::LighthouseScenario scenario_of(std::uint64_t seed) {
    constexpr double kDuration_s = 60.0;
    sim::LighthouseScenario scenario = test::flight_scenario(kDuration_s);
    scenario.errors = sim::ErrorScenario::workshop();
    scenario.stations.front().calibration.reset();
    scenario.trajectory = sim::make_random_manoeuvre({}, kDuration_s, sim::RandomStream(seed, "table 2"));
    return scenario;
  }

  sim::LighthouseSimulator simulator_;
  std::vector<lighthouse::Sweep> sweeps_;
  Known nominal_, calibrated_;
};

void print(const char* name, const test::FlightScore& score) {
  std::printf("%-34s %.3f deg %.2f mm RMS, %.2f deg %.1f mm at most, NEES %.2f, %d answers, %d ambiguous, %d refused\n",
              name, score.rotation_rms_deg(), score.position_rms_mm(), score.rotation_max_deg, score.position_max_mm,
              score.nees_per_freedom(), score.answers, score.ambiguous, score.refused);
}

MotionOptions options_of(const Known& known, const UncertaintyLimits& limits = {}) {
  MotionOptions options;
  options.systematic = known.systematic;
  options.limits = limits;
  return options;
}

TEST(MotionAccuracy, TenCalibratedManoeuvres) {
  std::array<test::FlightScore, 4> all, seen_well;
  test::FlightScore good, ignored;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Flight flight(seed);
    for (const bool calibrated : {false, true}) {
      const std::size_t column = calibrated ? 2 : 0;
      const Known& known = flight.assumptions(calibrated);
      track::TrackOptions epoch_options;
      epoch_options.solve.rho = kPaperRho;
      const auto epoch = std::make_unique<track::EpochTracker>(known.target, epoch_options);
      flight.track(*epoch, calibrated, kSettled_s, all[column], seen_well[column]);
      const auto motion = std::make_unique<MotionTracker>(known.target, options_of(known));
      flight.track(*motion, calibrated, kSettled_s, all[column + 1], seen_well[column + 1]);
    }
    const Known& known = flight.assumptions(true);
    const auto limited = std::make_unique<MotionTracker>(known.target, options_of(known, kGoodEnough));
    flight.track(*limited, true, 0.0, good, ignored);
  }
  print("each cycle alone", all[0]);
  print("+ motion", all[1]);
  print("+ calibration", all[2]);
  print("both", all[3]);
  print("both, five sensors lit and more", seen_well[3]);
  print("both, from the first, within limits", good);
  const test::FlightScore& both = all[3];
  EXPECT_GT(both.answers, 70'000);
  EXPECT_LT(both.position_rms_mm(), 1.5);
  EXPECT_LT(both.position_max_mm, 6.0);
  // With four coplanar sensors seen from ahead the tilt's sigma is more than a tenth of a degree: see below.
  EXPECT_LT(both.rotation_rms_deg(), 0.15);
  EXPECT_LT(seen_well[3].rotation_rms_deg(), 0.1);
  EXPECT_LT(all[1].nees_per_freedom(), 1.5);
  // With uncertainty limits every valid pose is within them, and there is nearly always one.
  EXPECT_LT(good.rotation_rms_deg(), 0.1);
  EXPECT_LT(good.position_rms_mm(), 1.5);
  EXPECT_LT(good.rotation_max_deg, 0.5);
  EXPECT_LT(good.position_max_mm, 6.0);
  EXPECT_GT(good.answers, 0.94 * (good.answers + good.ambiguous + good.refused));
}

/// Mean of samples that are independent of one another, and its standard error.
struct SampledMean {
  double value = 0.0, standard_error = 0.0;
};

SampledMean mean_of(const std::vector<double>& samples) {
  const auto count = static_cast<double>(samples.size());
  double sum = 0.0, square = 0.0;
  for (const double sample : samples) sum += sample;
  for (const double sample : samples) square += (sample - sum / count) * (sample - sum / count);
  return {sum / count, std::sqrt(square / (count * (count - 1.0)))};
}

// A calibration is one sample of its errors for a whole flight, so that a flight has one independent sample of the
// NEES: they scatter by 0.28, in position by 0.52. Two standard errors of their mean are what forty of them can tell.
TEST(MotionAccuracy, FortyCalibrationsAreAsGoodAsTheySay) {
  std::vector<double> nees, of_position, of_rotation;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Flight flight(seed);
    const Known& known = flight.assumptions(true);
    const auto motion = std::make_unique<MotionTracker>(known.target, options_of(known));
    test::FlightScore score, ignored;
    flight.track(*motion, true, kSettled_s, score, ignored);
    nees.push_back(score.nees_per_freedom());
    of_position.push_back(score.position_nees / (3.0 * score.answers));
    of_rotation.push_back(score.rotation_nees / (3.0 * score.answers));
  }
  const SampledMean all = mean_of(nees), position = mean_of(of_position), rotation = mean_of(of_rotation);
  std::printf("forty calibrated flights: NEES %.3f +- %.3f, position %.3f +- %.3f, rotation %.3f +- %.3f\n", all.value,
              all.standard_error, position.value, position.standard_error, rotation.value, rotation.standard_error);
  for (const SampledMean& mean : {all, position}) {
    EXPECT_GT(mean.value + 2.0 * mean.standard_error, 0.9);
    EXPECT_LT(mean.value - 2.0 * mean.standard_error, 1.1);
    EXPECT_LT(mean.standard_error, 0.1);
  }
  // Known to 0.01 and below 0.9 for another reason than the calibration: the jerk of the moving models.
  EXPECT_GT(rotation.value, 0.8);
  EXPECT_LT(rotation.value, 1.1);
}

// Why 0.1 deg at every time and 0.5 deg at most cannot be reached in these flights: a filter that knows everything but
// the pose is not better.
TEST(MotionAccuracy, NoFilterKnowsTheTiltOfAPlateSeenFromAhead) {
  double square = 0.0, worst = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Flight(seed).covariance_at_the_truth([&](double sigma_rad) {
      square += sigma_rad * sigma_rad;
      worst = std::max(worst, sigma_rad);
      ++count;
    });
  }
  const double rms_deg = std::sqrt(square / count) * kDegPerRad;
  std::printf("at the truth: attitude %.3f deg RMS, %.2f deg at its worst (1 sigma)\n", rms_deg, worst * kDegPerRad);
  EXPECT_GT(worst * kDegPerRad, 0.5);
  EXPECT_GT(rms_deg, 0.07);
}

}  // namespace
}  // namespace pharos::motion
