// SPDX-License-Identifier: Apache-2.0
// Real stations, with only their OOTX calibrations.
#include <gtest/gtest.h>

#include <bitset>
#include <memory>
#include <vector>

#include "host/table/edges_reader.hpp"
#include "host/table/target_file.hpp"
#include "pharos/lighthouse/calibration_store.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/motion/motion_tracker.hpp"
#include "tests/support/real_data.hpp"

namespace pharos::motion {
namespace {

struct Outcome {
  int suspected = 0;
  int lit = 0, valid = 0;  // sweeps of four and more sensors of the target
  double nis = 0.0, residual_chi2 = 0.0;
  int nis_degrees_of_freedom = 0, residual_degrees_of_freedom = 0;

  double valid_fraction() const { return static_cast<double>(valid) / lit; }
  double nis_per_degree_of_freedom() const { return nis / nis_degrees_of_freedom; }
  double residual_chi2_per_degree_of_freedom() const { return residual_chi2 / residual_degrees_of_freedom; }
  void add(const Outcome& other) {
    nis += other.nis;
    nis_degrees_of_freedom += other.nis_degrees_of_freedom;
  }
};

std::size_t sensors_lit(const lighthouse::Sweep& sweep, const Target& target) {
  std::bitset<kMaxSensors> lit;
  for (const lighthouse::Hit& hit : sweep.hits) {
    if (find_sensor(target, hit.sensor) != nullptr) lit.set(hit.sensor);
  }
  return lit.count();
}

// By station; and the fraction of the time with four lit sensors of one station in which a pose is not older than a
// turn.
struct Outcomes {
  std::array<Outcome, kMaxStations> of;
  int lit = 0, known = 0;

  double known_fraction() const { return static_cast<double>(known) / lit; }
};

Outcomes track(const std::string& recording, const std::string& target_name) {
  const std::filesystem::path folder = test::real_data("lighthouse");
  const Target target = host::read_target((folder / target_name).string()).target;
  std::vector<lighthouse::Sweep> sweeps;
  lighthouse::CalibrationStore stations;
  host::EdgesReader reader{host::ByteSource((folder / recording).string())};
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  while (const auto pulse = reader.next()) {
    decoder->push(*pulse);
    while (const auto sweep = decoder->take_sweep()) sweeps.push_back(*sweep);
    while (const auto payload = decoder->take_ootx()) stations.push(*payload);
  }
  const auto tracker = std::make_unique<MotionTracker>(target, MotionOptions{});
  for (std::uint8_t station = 0; station < kMaxStations; ++station) {
    if (const auto* calibration = stations.in_use(station)) tracker->set_calibration(station, *calibration);
  }
  constexpr std::int64_t kTurn_ticks = 833'334;
  std::int64_t last_valid_ticks = -kTurn_ticks;
  Outcomes outcomes;
  for (const lighthouse::Sweep& sweep : sweeps) {
    const auto result = tracker->push(sweep);
    if (!result) continue;
    Outcome& outcome = outcomes.of[result->station];
    const bool lit = sensors_lit(sweep, target) >= 4;
    outcome.lit += lit ? 1 : 0;
    outcomes.lit += lit ? 1 : 0;
    outcome.suspected += !result->pose && result->pose.error() == pose::Refusal::kSuspectTarget ? 1 : 0;
    if (result->pose) last_valid_ticks = result->time_ticks;
    if (lit && result->time_ticks - last_valid_ticks <= kTurn_ticks) ++outcomes.known;
    if (!result->pose) continue;
    outcome.valid += lit ? 1 : 0;
    outcome.nis += tracker->innovation().nis;
    outcome.nis_degrees_of_freedom += tracker->innovation().nis_degrees_of_freedom;
    outcome.residual_chi2 += tracker->innovation().residual_chi2;
    outcome.residual_degrees_of_freedom += tracker->innovation().residual_degrees_of_freedom;
  }
  return outcomes;
}

TEST(MotionRecordings, AQuickHandKeepsItsPose) {
  PHAROS_NEEDS_DATA("lighthouse");
  const auto outcomes = track("controller_quick.edges.csv.gz", "controller_quick.target_a.csv");
  // The near station sees the hand all the time; the far one four to five sensors in a quarter of it, with half a
  // second of darkness and more before many a sweep: that sweep has only the near station's pose.
  EXPECT_GT(outcomes.of[1].lit, 3000);
  EXPECT_GE(outcomes.known_fraction(), 0.99);
  EXPECT_GE(outcomes.of[1].valid_fraction(), 0.99);
  EXPECT_LT(outcomes.of[1].residual_chi2_per_degree_of_freedom(), 1.5);
  // One is ideal; the hand rotates at 30 rad/s and reverses within a turn in which a station is dark.
  Outcome both = outcomes.of[0];
  both.add(outcomes.of[1]);
  for (const Outcome& outcome : {outcomes.of[1], both}) {
    EXPECT_GT(outcome.nis_per_degree_of_freedom(), 0.8);
    EXPECT_LT(outcome.nis_per_degree_of_freedom(), 1.3);
  }
  std::printf(
      "with a pose: %.2f %% of the time, %.2f %% of station 0's sweeps, %.2f %% of station 1's; innovations %.2f, "
      "%.2f (both %.2f) and %.2f per degree of freedom\n",
      100.0 * outcomes.known_fraction(), 100.0 * outcomes.of[0].valid_fraction(),
      100.0 * outcomes.of[1].valid_fraction(), outcomes.of[0].nis_per_degree_of_freedom(),
      outcomes.of[1].nis_per_degree_of_freedom(), both.nis_per_degree_of_freedom(),
      outcomes.of[1].residual_chi2_per_degree_of_freedom());
}

TEST(MotionRecordings, StationaryBodiesStayWithinThePredictedCovariance) {
  PHAROS_NEEDS_DATA("lighthouse");
  for (const std::string name : {"hmd_static", "two_bodies_hmd", "two_bodies_controller"}) {
    const auto outcomes = track(name + ".edges.csv.gz", name + ".target.csv");
    for (const Outcome& outcome : outcomes.of) {
      EXPECT_GE(outcome.valid_fraction(), 0.985) << name;
      // One is ideal. Sensors are tens of arcsec from their positions in the target file; covariances are increased for
      // it.
      EXPECT_LT(outcome.nis_per_degree_of_freedom(), 2.0) << name;
      if (outcome.residual_degrees_of_freedom > 0) {
        EXPECT_LT(outcome.residual_chi2_per_degree_of_freedom(), 1.5) << name;
      }
    }
  }
}

// Hands, reflections and the far station's dropouts are no fault of the target's.
TEST(MotionRecordings, NoTargetIsSuspected) {
  PHAROS_NEEDS_DATA("lighthouse");
  for (const char* recording : {"controller_quick", "hmd_static", "two_bodies_controller", "two_bodies_hmd"}) {
    const std::string name = recording;
    const auto outcomes =
        track(name + ".edges.csv.gz", name + (name == "controller_quick" ? ".target_a.csv" : ".target.csv"));
    for (const Outcome& outcome : outcomes.of) {
      std::printf("%s: %d of %d sweeps suspected\n", recording, outcome.suspected, outcome.lit);
      EXPECT_LT(10'000 * outcome.suspected, outcome.lit) << recording;
    }
  }
}

}  // namespace
}  // namespace pharos::motion
