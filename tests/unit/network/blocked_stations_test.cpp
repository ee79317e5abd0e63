// SPDX-License-Identifier: Apache-2.0
// A small target that a hand moves while now the one, now the other station does not see it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/network/network_tracker.hpp"
#include "unit/network/room.hpp"

namespace pharos::network {
namespace {

constexpr double kLength_s = 40.0, kFirst_s = 1.0;
constexpr double kSeen_s = 0.5, kBlocked_s = 0.12;       // mean times of a station
constexpr double kWidestView = 0.25;                     // cosine between the deck's normal and a station
constexpr double kMissed = 0.03;                         // of the hits
constexpr double kNoise_rad = 30e-6, kPlane_rad = 3e-4;  // of a hit, of a plane
constexpr double kTogether_s = 0.02, kNear_s = 0.05, kEpoch_s = 0.1;
constexpr std::array<double, 2> kTurn_s = {959e3 / 48e6, 957e3 / 48e6};

// Sums of sines: up to some 3 m/s and 5 rad/s.
class HandMotion {
 public:
  explicit HandMotion(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < kTerms; ++i) {
      const auto order = static_cast<double>(i);
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double size_m = 0.5 / (1.0 + order + 0.42 * order * order) * (0.5 + unit(random));
        shift_[i].set(k, 0.45 + 0.75 * order + 0.45 * unit(random), k == 2 ? 0.6 * size_m : size_m, unit(random));
        const double size_rad = 0.45 / (1.0 + order) * (0.5 + unit(random));
        turn_[i].set(k, 0.5 + 0.9 * order + 0.5 * unit(random), size_rad, unit(random));
      }
    }
  }
  WorldFromBody at(double t) const {
    Vector3 position_m(0.0, 0.0, 0.9), turn_rad = Vector3::Zero();
    for (std::size_t i = 0; i < kTerms; ++i) {
      position_m += shift_[i].at(t);
      turn_rad += turn_[i].at(t);
    }
    return {rotation_exp(turn_rad), position_m};
  }

 private:
  static constexpr std::size_t kTerms = 6;
  struct Sines {
    Vector3 rate, amplitude, phase;
    void set(Eigen::Index k, double rate_rad_s, double most, double turns) {
      rate[k] = rate_rad_s;
      amplitude[k] = most;
      phase[k] = kTwoPi * turns;
    }
    Vector3 at(double t) const { return (amplitude.array() * (t * rate + phase).array().sin()).matrix(); }
  };
  std::array<Sines, kTerms> shift_, turn_;
};

struct LitSweep {
  double time_s = 0.0;
  std::uint8_t station = 0;
  std::size_t plane = 0;
  std::vector<Hit> hits;
};

// What the target's sensors see of both stations, and a lone reflection of a whole sweep now and then.
std::vector<LitSweep> light_of(const HandMotion& motion, const Stations& stations, const Target& target,
                               double reflections, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> gauss(0.0, 1.0);
  std::vector<LitSweep> sweeps;
  for (std::uint8_t s = 0; s < 2; ++s) {
    bool blocked = false;
    double changes_s = 0.0;
    for (double turn_s = kTurn_s[s] * unit(random); turn_s < kLength_s; turn_s += kTurn_s[s]) {
      for (std::size_t plane = 0; plane < kPlanes; ++plane) {
        LitSweep sweep{turn_s + 0.0067 * static_cast<double>(plane), s, plane, {}};
        while (sweep.time_s > changes_s) {
          blocked = !blocked;
          changes_s -= (blocked ? kBlocked_s : kSeen_s) * std::log(1.0 - unit(random));
        }
        const WorldFromBody body = motion.at(sweep.time_s);
        const WorldFromStation& T = *stations[s].T_world_station;
        if (blocked || (T.t - body.t).normalized().dot(body.R.col(2)) < kWidestView) continue;
        const double shift_rad = unit(random) < reflections ? 0.05 * gauss(random) : 0.0;
        for (const SensorPlacement& sensor : target) {
          if (unit(random) < kMissed) continue;
          const double t = sweep.time_s + 1e-5 * sensor.sensor;
          const Vector3 p = T.inverse() * (motion.at(t) * sensor.position_m);
          if (p.z() < 0.1) continue;
          const double angle_rad = raw_angle(stations[s], plane, p) + kNoise_rad * gauss(random);
          sweep.hits.push_back({t, sensor.sensor, angle_rad + shift_rad});
        }
        if (!sweep.hits.empty()) sweeps.push_back(sweep);
      }
    }
  }
  std::sort(sweeps.begin(), sweeps.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return sweeps;
}

// Instants at which both stations showed both planes within 20 ms: there crossing beams tell the position.
std::vector<double> crossings_of(const std::vector<LitSweep>& sweeps) {
  std::array<double, 4> last_s{-1.0, -1.0, -1.0, -1.0};
  std::vector<double> out;
  for (const LitSweep& sweep : sweeps) {
    if (sweep.hits.size() < 2) continue;
    last_s[2U * sweep.station + sweep.plane] = sweep.time_s;
    const double first_s = *std::min_element(last_s.begin(), last_s.end());
    if (sweep.time_s > kFirst_s && sweep.time_s - first_s < kTogether_s) out.push_back(sweep.time_s);
  }
  return out;
}

struct Flights {
  int ok = 0, beyond_position = 0, beyond_attitude = 0;  // answers; those beyond five of their sigmas
  int epochs = 0, answered = 0;                          // tenths of a second in which beams cross
};

double chi2_of(const Vector3& error, const Matrix3& covariance) {
  return error.dot((covariance + 1e-9 * Matrix3::Identity()).inverse() * error);
}

void judge(const NetworkResult& result, const WorldFromBody& truth, Flights& out) {
  const Matrix3 turn = result.pose.value().R * truth.R.transpose();
  const Vector3 axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  const Vector3 turned_rad = rotation_angle_between(result.pose.value().R, truth.R) * axis.stableNormalized();
  ++out.ok;
  const Vector3 error_m = result.pose.value().t - truth.t;
  if (chi2_of(error_m, result.covariance.bottomRightCorner<3, 3>()) > 25.0) ++out.beyond_position;
  if (chi2_of(turned_rad, result.covariance.topLeftCorner<3, 3>()) > 25.0) ++out.beyond_attitude;
}

void count_epochs(const std::vector<double>& crossings_s, std::vector<double> answers_s, Flights& out) {
  std::sort(answers_s.begin(), answers_s.end());
  double last = -1.0, last_answered = -1.0;
  for (const double time_s : crossings_s) {
    const double epoch = std::floor(time_s / kEpoch_s);
    if (epoch != last) ++out.epochs;
    last = epoch;
    const auto near = std::lower_bound(answers_s.begin(), answers_s.end(), time_s - kNear_s);
    if (near == answers_s.end() || *near > time_s + kNear_s || epoch == last_answered) continue;
    ++out.answered;
    last_answered = epoch;
  }
}

// Stations whose planes are off by what is stated, sensors by 0.2 mm.
void fly(std::uint32_t seed, double reflections, Flights& out) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0.0, 1.0);
  const HandMotion motion(random);
  Stations known = two_stations(Generation::kLighthouse2);
  for (Station& station : known) station.sigmas = StationSigmas{0.005, 0.0, kPlane_rad};
  Stations real = known;
  for (Station& station : real) {
    for (auto& plane : station.plane) plane.phase_rad += kPlane_rad * gauss(random);
  }
  Target built = deck();
  for (SensorPlacement& sensor : built) {
    for (Eigen::Index k = 0; k < 3; ++k) sensor.position_m[k] += 0.0002 * gauss(random);
  }
  const std::vector<LitSweep> sweeps = light_of(motion, real, built, reflections, random);
  const auto tracker = std::make_unique<NetworkTracker>(known, deck(), NetworkOptions{});
  std::vector<double> answers_s;
  const auto take = [&](const std::optional<NetworkResult>& result) {
    if (!result || !result->pose.ok() || result->ambiguous) return;
    answers_s.push_back(result->time_s);
    judge(*result, motion.at(result->time_s), out);
  };
  for (const LitSweep& sweep : sweeps) {
    for (const Hit& hit : sweep.hits) take(tracker->push(sweep.station, sweep.plane, hit));
  }
  while (const auto last = tracker->flush()) take(last);
  count_epochs(crossings_of(sweeps), answers_s, out);
}

Flights fly_all(double reflections) {
  Flights out;
  for (std::uint32_t seed = 601; seed < 605; ++seed) fly(seed, reflections, out);
  return out;
}

// The filter may not know the position, or hold the mirrored attitude of a flat target, when a station comes back:
// 4 of 769 epochs had no answer, and one answer of ten an attitude beyond five sigmas.
TEST(BlockedStations, AreBelievedAtOnceWhenTheyComeBack) {
  const Flights seen = fly_all(0.0);
  EXPECT_GT(seen.epochs, 700);
  EXPECT_GE(seen.answered, seen.epochs - 3);
  EXPECT_GT(seen.ok, 12000);
  EXPECT_LE(seen.beyond_position, 10);             // 16 before
  EXPECT_LE(seen.beyond_attitude, seen.ok / 300);  // 50 while sensors' places were noise
}

// In flights 112 and 115 the attitude is the mirrored one for a moment, and some of the sensors are not hit: their
// middle is elsewhere. Five positions were beyond five sigmas, by 7 to 24 mm.
TEST(BlockedStations, AMirroredAttitudeDoesNotMoveThePosition) {
  Flights seen;
  for (const std::uint32_t seed : {112U, 115U}) fly(seed, 0.0, seen);
  EXPECT_GT(seen.ok, 6000);
  EXPECT_LE(seen.beyond_position, 1);
}

// One plane of hundred shows another place: 87 positions were beyond five sigmas.
TEST(BlockedStations, AReflectedSweepDoesNotMoveTheTarget) {
  const Flights seen = fly_all(0.01);
  EXPECT_GE(seen.answered, seen.epochs - 5);
  EXPECT_GT(seen.ok, 12000);
  EXPECT_LE(seen.beyond_position, seen.ok / 300);
  EXPECT_LE(seen.beyond_attitude, seen.ok / 100);
}

// The first sweeps of a station that comes back, and a reflection: filter and position of the same light differ, and a
// row counts by how much, beyond what chance makes. 18 positions were beyond five sigmas.
TEST(BlockedStations, RowsOfWhichFilterAndPositionDifferSaySo) {
  Flights seen;
  for (const std::uint32_t seed : {601U, 602U}) fly(seed, 0.01, seen);
  EXPECT_GT(seen.ok, 5000);
  EXPECT_LE(seen.beyond_position, 15);
}

}  // namespace
}  // namespace pharos::network
