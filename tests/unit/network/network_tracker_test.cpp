// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "unit/network/room.hpp"

namespace pharos::network {
namespace {

WorldFromBody body_at(double t) {
  return {rotation_exp({0.2 * std::sin(0.8 * t), 0.2 * std::cos(0.7 * t), 0.5 * std::sin(0.3 * t)}),
          Vector3(0.6 * std::sin(0.9 * t), 0.5 * std::cos(0.6 * t), 0.9 + 0.2 * std::sin(1.1 * t))};
}

// Both stations in turn, a plane every 8.3 ms, noise of 8 arcsec; the tracker knows `known`, light comes from `real`.
void run(Generation generation, const Stations& real, const Stations& known) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 40e-6);
  const Target target = deck();
  const auto tracker = std::make_unique<NetworkTracker>(known, target, NetworkOptions{});
  int ok = 0, wrong = 0, rows = 0;
  double square = 0.0;
  const auto take = [&](const std::optional<NetworkResult>& result) {
    if (!result) return;
    ++rows;
    if (!result->pose.ok() || result->time_s < 1.0) return;
    const Vector3 error = result->pose.value().t - body_at(result->time_s).t;
    const double sigma = std::sqrt(result->covariance.bottomRightCorner<3, 3>().trace());
    square += error.squaredNorm();
    ++ok;
    if (error.norm() > 0.01 && error.norm() > 5.0 * sigma) ++wrong;
  };
  for (int k = 0; k < 1200; ++k) {
    const std::size_t plane = static_cast<std::size_t>(k % 2), station = static_cast<std::size_t>(k / 2 % 2);
    for (const SensorPlacement& sensor : target) {
      const double t = k / 120.0 + 0.002 + 1e-5 * sensor.sensor;
      const Vector3 p = real[station].T_world_station->inverse() * (body_at(t) * sensor.position_m);
      const double angle = raw_angle(real[station], plane, p) + noise(random);
      take(tracker->push(static_cast<std::uint8_t>(station), plane, {t, sensor.sensor, angle}));
    }
  }
  while (const auto last = tracker->flush()) take(last);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(ok, 9 * rows / 10 - 130);
  EXPECT_LT(std::sqrt(square / ok), 0.006) << static_cast<int>(generation);
}

TEST(NetworkTracker, FollowsASmallTargetUnderTwoStationsOfEitherGeneration) {
  for (const Generation generation : {Generation::kLighthouse1, Generation::kLighthouse2}) {
    run(generation, two_stations(generation), two_stations(generation));
  }
}

// Rotors of different periods drift through each other, so that the sweep that is over last may be 4 ms older than
// another: at 2 m/s 8 mm.
TEST(PositionFix, HoldsAtTheTimeThatIsAskedForWhateverTheOrderOfOverlappingSweeps) {
  const Stations stations = two_stations(Generation::kLighthouse2);
  const Target target = deck();
  const Vector3 velocity_m_s(1.6, -1.2, 0.0);
  const auto at = [&](double t) {
    return WorldFromBody{Matrix3::Identity(), Vector3(0.1, 0.2, 0.9) + t * velocity_m_s};
  };
  std::vector<PlaneSweep> sweeps;
  for (int turn = 0; turn < 3; ++turn) {
    for (std::size_t k = 0; k < 4; ++k) {
      PlaneSweep sweep;
      sweep.station = k % 2;
      sweep.plane = k / 2;
      const double begin_s =
          0.02 * turn + 0.006 * static_cast<double>(sweep.plane) + (sweep.station == 0 ? 0.004 : 0.0);
      for (const SensorPlacement& sensor : target) {
        const double t = begin_s + 1e-5 * sensor.sensor;
        const Vector3 p = stations[sweep.station].T_world_station->inverse() * (at(t) * sensor.position_m);
        sweep.hits.push_back({t, sensor.sensor, raw_angle(stations[sweep.station], sweep.plane, p)});
      }
      sweeps.push_back(sweep);
    }
  }
  SweepView recent;
  double now_s = 0.0;
  for (const PlaneSweep& sweep : sweeps) {
    recent.push_back(&sweep);
    now_s = std::max(now_s, sweep.time_s());
  }
  ASSERT_LT(recent.back()->time_s(), now_s - 0.003);
  NetworkState near;
  near.pose = at(now_s);
  near.pose.t += Vector3(0.05, 0.05, 0.05);
  const auto fix = fix_of(recent, stations, target, near, now_s, NetworkOptions{}.noise, 0.0);
  ASSERT_TRUE(fix);
  EXPECT_LT((fix->position_m - at(now_s).t).norm(), 0.001);
  EXPECT_LT((fix->velocity_m_s - velocity_m_s).norm(), 0.05);
}

// Poses of stations as peers find them from a target on the floor: each station turned about the world's origin, its
// range off by a percent. Nothing is stated of it; a hand moves the target through the room.
TEST(NetworkTracker, StatesWhatAGeometryFoundFromATargetOnTheFloorLeaves) {
  int ok = 0, beyond = 0;
  double nees = 0.0;
  for (std::uint32_t seed = 501; seed < 509; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> gauss(0.0, 1.0);
    const Generation generation = seed % 2 == 0 ? Generation::kLighthouse1 : Generation::kLighthouse2;
    const Stations real = two_stations(generation);
    Stations known = real;
    for (Station& station : known) {
      const Vector3 axis(gauss(random), gauss(random), gauss(random));
      const Matrix3 turn = rotation_exp(0.009 * axis);
      const double scale = 1.0 + 0.006 * gauss(random);
      station.T_world_station =
          WorldFromStation{turn * station.T_world_station->R, scale * (turn * station.T_world_station->t)};
      station.sigmas.reset();
    }
    const Target target = deck();
    const auto tracker = std::make_unique<NetworkTracker>(known, target, NetworkOptions{});
    const auto at = [](double t) {
      WorldFromBody body = body_at(1.7 * t);
      body.t.head<2>() *= 2.0;
      return body;
    };
    const auto take = [&](const std::optional<NetworkResult>& result) {
      if (!result || !result->pose.ok() || result->ambiguous) return;
      const Vector3 error = result->pose.value().t - at(result->time_s).t;
      const double square = error.dot(result->covariance.bottomRightCorner<3, 3>().inverse() * error);
      ++ok;
      if (square > 25.0) ++beyond;
      nees += square / 3.0;
    };
    for (int k = 0; k < 1200; ++k) {
      const std::size_t plane = static_cast<std::size_t>(k % 2), station = static_cast<std::size_t>(k / 2 % 2);
      for (const SensorPlacement& sensor : target) {
        const double t = k / 120.0 + 0.002 + 1e-5 * sensor.sensor;
        const Vector3 p = real[station].T_world_station->inverse() * (at(t) * sensor.position_m);
        const double angle = raw_angle(real[station], plane, p) + 40e-6 * gauss(random);
        take(tracker->push(static_cast<std::uint8_t>(station), plane, {t, sensor.sensor, angle}));
      }
    }
    while (const auto last = tracker->flush()) take(last);
  }
  EXPECT_GT(ok, 8000);
  EXPECT_EQ(beyond, 0);
  EXPECT_LT(nees / ok, 2.0);
}

// A room that is too large by a percent about its middle: beyond five sigmas unless the stations' joint error says so.
TEST(NetworkTracker, StatesWhatTheJointErrorOfItsStationsMovesAPositionBy) {
  const Vector3 middle(0.0, 0.0, 0.9);
  for (const bool stated : {false, true}) {
    const Stations real = two_stations(Generation::kLighthouse2);
    Stations known = real;
    for (Station& station : known) {
      const Vector3 shift = 0.01 * (station.T_world_station->t - middle);
      station.T_world_station->t += shift;
      station.sigmas = StationSigmas{0.002, 0.0, 0.1e-3};
      if (stated) station.modes.push_back((Vector6() << Vector3::Zero(), shift).finished());
    }
    std::mt19937 random(11);
    std::normal_distribution<double> noise(0.0, 20e-6);
    const Target target = deck();
    const auto tracker = std::make_unique<NetworkTracker>(known, target, NetworkOptions{});
    int ok = 0, beyond = 0;
    const auto at = [](double t) { return WorldFromBody{body_at(t).R, 1.5 * body_at(t).t}; };
    const auto take = [&](const std::optional<NetworkResult>& result) {
      if (!result || !result->pose.ok() || result->ambiguous) return;
      const Vector3 error = result->pose.value().t - at(result->time_s).t;
      ++ok;
      if (error.dot(result->covariance.bottomRightCorner<3, 3>().inverse() * error) > 25.0) ++beyond;
    };
    for (int k = 0; k < 1200; ++k) {
      const std::size_t plane = static_cast<std::size_t>(k % 2), station = static_cast<std::size_t>(k / 2 % 2);
      for (const SensorPlacement& sensor : target) {
        const double t = k / 120.0 + 0.002 + 1e-5 * sensor.sensor;
        const Vector3 p = real[station].T_world_station->inverse() * (at(t) * sensor.position_m);
        const double angle = raw_angle(real[station], plane, p) + noise(random);
        take(tracker->push(static_cast<std::uint8_t>(station), plane, {t, sensor.sensor, angle}));
      }
    }
    EXPECT_GT(ok, 1000) << stated;
    if (stated) {
      EXPECT_EQ(beyond, 0);
    } else {
      EXPECT_GT(beyond, ok / 4);
    }
  }
}

// What a tracker makes of a station that somebody moves at half time.
struct Moved {
  std::uint64_t exclusions = 0;
  std::array<bool, 3> excluded{};
  int rows = 0, ok = 0, wrong = 0;  // after two seconds with the moved station
  int told = 0;                     // rows that say so
};

Moved move_a_station(Generation generation, std::size_t count, std::size_t moved, const Vector6& by) {
  Stations known = two_stations(generation);
  if (count == 3) {
    Station third = known[1];
    third.number = 2;
    third.T_world_station = looking(Vector3(2.4, 0.6, 2.8), Vector3(0, 0, 0.8));
    known.push_back(third);
  }
  Stations real = known;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 40e-6);
  const Target target = deck();
  const auto tracker = std::make_unique<NetworkTracker>(known, target, NetworkOptions{});
  Moved out;
  const auto take = [&](const std::optional<NetworkResult>& result) {
    if (!result || result->time_s < 7.0) return;
    ++out.rows;
    if ((result->flags & kStationExcluded) != 0) ++out.told;
    if (!result->pose.ok() || result->ambiguous) return;
    ++out.ok;
    if ((result->pose.value().t - body_at(result->time_s).t).norm() > 0.03) ++out.wrong;
  };
  const std::size_t slots = 2 * count;
  for (int k = 0; k < 1200; ++k) {
    if (k == 600) real[moved].T_world_station = real[moved].T_world_station->moved_by(by);
    const std::size_t slot = static_cast<std::size_t>(k) % slots, plane = slot % 2, station = slot / 2;
    for (const SensorPlacement& sensor : target) {
      const double t = k / 120.0 + 0.002 + 1e-5 * sensor.sensor;
      const Vector3 p = real[station].T_world_station->inverse() * (body_at(t) * sensor.position_m);
      const double angle = raw_angle(real[station], plane, p) + noise(random);
      take(tracker->push(static_cast<std::uint8_t>(station), plane, {t, sensor.sensor, angle}));
    }
  }
  out.exclusions = tracker->counters().exclusions;
  for (std::size_t s = 0; s < count; ++s) out.excluded[s] = tracker->excluded(s);
  return out;
}

TEST(NetworkTracker, ExcludesAStationThatWasMoved) {
  for (const Generation generation : {Generation::kLighthouse1, Generation::kLighthouse2}) {
    for (std::size_t moved = 0; moved < 3; ++moved) {
      for (const double metres : {0.1, 0.3}) {
        Vector6 by = Vector6::Zero();
        by << 0.05, 0.0, 0.0, metres, 0.5 * metres, 0.2 * metres;
        const Moved seen = move_a_station(generation, 3, moved, by);
        const auto which = testing::Message()
                           << "LH" << static_cast<int>(generation) << " station " << moved << " " << metres;
        for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(seen.excluded[s], s == moved) << which << " place " << s;
        EXPECT_GE(seen.exclusions, 1U) << which;
        EXPECT_EQ(seen.wrong, 0) << which;
        // A third of the sweeps are its own.
        EXPECT_GT(seen.ok, 6 * seen.rows / 10) << which;
        EXPECT_GE(seen.told, seen.ok) << which;
      }
    }
  }
}

// Turned and moved on a table: three bearings in the plane contradict, but any two of them agree.
TEST(NetworkTracker, DoesNotAnswerWhereStationsContradictAndItIsNotClearWhichIsWrong) {
  for (const Generation generation : {Generation::kLighthouse1, Generation::kLighthouse2}) {
    Vector6 by;
    by << 0.0, 0.0, 0.05, 0.1, 0.05, 0.0;
    EXPECT_EQ(move_a_station(generation, 3, 1, by).wrong, 0) << static_cast<int>(generation);
  }
}

// Sensors on a hemisphere of 60 mm: its apparent size tells its range, so that one station alone is answered.
Target dome() {
  Target target;
  for (std::uint8_t k = 0; k < 12; ++k) {
    const double height = (k + 0.5) / 12, radius = std::sqrt(1.0 - height * height), turn = 2.4 * k;
    target.push_back({k, 0.06 * Vector3(radius * std::cos(turn), radius * std::sin(turn), height), Vector3::UnitZ()});
  }
  return target;
}

// Two stations of which one is moved at 4 s and stands as before from 8 s on.
struct Disputed {
  int ok_before = 0, ok_while = 0, ok_after = 0;  // from a second after it was moved, from two after it was put back
  int beyond = 0;                                 // at any time: answers beyond five of their sigmas
};

Disputed dispute(Generation generation, std::size_t moved, const Vector6& by) {
  const Stations known = two_stations(generation);
  Stations real = known;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 40e-6);
  const Target target = dome();
  const auto tracker = std::make_unique<NetworkTracker>(known, target, NetworkOptions{});
  Disputed out;
  const auto take = [&](const std::optional<NetworkResult>& result) {
    if (!result || !result->pose.ok() || result->ambiguous) return;
    const double t = result->time_s;
    if (t < 4.0) ++out.ok_before;
    if (t > 5.0 && t < 8.0) ++out.ok_while;
    if (t > 10.0) ++out.ok_after;
    const Vector3 error = result->pose.value().t - body_at(t).t;
    if (error.dot(result->covariance.bottomRightCorner<3, 3>().inverse() * error) > 25.0) ++out.beyond;
  };
  for (int k = 0; k < 1440; ++k) {
    if (k == 480) real[moved].T_world_station = real[moved].T_world_station->moved_by(by);
    if (k == 960) real = known;
    const std::size_t plane = static_cast<std::size_t>(k % 2), station = static_cast<std::size_t>(k / 2 % 2);
    for (const SensorPlacement& sensor : target) {
      const double t = k / 120.0 + 0.002 + 1e-5 * sensor.sensor;
      const Vector3 p = real[station].T_world_station->inverse() * (body_at(t) * sensor.position_m);
      take(tracker->push(static_cast<std::uint8_t>(station), plane,
                         {t, sensor.sensor, raw_angle(real[station], plane, p) + noise(random)}));
    }
  }
  return out;
}

// Two stations do not tell which of them was moved, and the other may be the wrong one.
TEST(NetworkTracker, DoesNotAnswerWhileTwoStationsContradictEachOther) {
  for (const Generation generation : {Generation::kLighthouse1, Generation::kLighthouse2}) {
    for (std::size_t moved = 0; moved < 2; ++moved) {
      for (const double metres : {0.02, 0.1, 0.3}) {
        Vector6 by;
        by << 0.05, 0.0, 0.0, metres, 0.5 * metres, 0.2 * metres;
        const Disputed seen = dispute(generation, moved, by);
        const auto which = testing::Message()
                           << "LH" << static_cast<int>(generation) << " station " << moved << " " << metres;
        EXPECT_GT(seen.ok_before, 380) << which;
        EXPECT_EQ(seen.ok_while, 0) << which;
        EXPECT_GT(seen.ok_after, 200) << which;
        // What is moved by little is noticed, at the latest, after the 25 sweeps in a row that a dispute takes.
        EXPECT_LE(seen.beyond, metres < 0.1 ? 25 : 0) << which;
      }
    }
  }
}

TEST(NetworkTracker, LeavesOutHitsOfUnknownStationsAndSensors) {
  const Stations stations = two_stations(Generation::kLighthouse2);
  const auto tracker = std::make_unique<NetworkTracker>(stations, deck(), NetworkOptions{});
  EXPECT_FALSE(tracker->push(9, 0, {1.0, 0, 0.1}));
  EXPECT_FALSE(tracker->push(0, 0, {1.0, 0, NAN}));
  EXPECT_EQ(tracker->counters().hits_unknown, 2U);
  tracker->push(0, 0, {1.0, 30, 0.1});
  const auto result = tracker->flush();
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->pose.ok());
}

}  // namespace
}  // namespace pharos::network
