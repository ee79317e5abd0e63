// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/approach_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/linear/dense.hpp"
#include "host/mounting/mounting_file.hpp"
#include "host/mounting/source_table.hpp"
#include "pharos/base/units.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/sim/approach/approach_writer.hpp"

namespace pharos::sim {
namespace {

std::string scenario_path(const std::string& name) {
  return std::string(PHAROS_SCENARIOS) + "/approach_" + name + ".toml";
}

ApproachScenario nominal() { return read_approach_scenario(scenario_path("nominal")); }

// Nothing but white noise.
ApproachScenario without_slow_errors(ApproachScenario scenario) {
  for (ApproachSource& source : scenario.sources) {
    source.bias = {0.0, 0.0, 60.0};
    source.scale_sigma = source.drift_deg_per_sqrt_s = source.drift_mm_per_sqrt_s = 0.0;
    source.ambiguous_beyond_m.reset();
  }
  return scenario;
}

// delta of the measured pose to the truth, without the turn where it was not measured; squared in its covariance.
double normalised_square(const ApproachMeasurement& m, const host::SensorFromFeature& truth, int& freedom) {
  Vector6 error = pose_difference(truth, m.pose);
  if (!m.has_turn) {
    const Vector3 n = m.pose.R.col(2), n_true = truth.R.col(2);
    error.head<3>() = n.cross(n_true);
  }
  const host::DenseEigen eigen = host::dense_eigen(m.covariance);
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    if (eigen.values[i] < 1e-16) continue;
    sum += std::pow(eigen.vectors.col(i).dot(error), 2) / eigen.values[i];
    ++freedom;
  }
  return sum;
}

TEST(ApproachSimulator, EveryScenarioThatShipsIsReadAndSeenByItsSources) {
  for (const char* name : {"nominal", "no_lighthouse", "tumbling", "sun_in_camera", "faults", "mounting"}) {
    const ApproachScenario scenario = read_approach_scenario(scenario_path(name));
    const ApproachSimulator simulator(scenario, 1);
    for (std::size_t i = 0; i < scenario.sources.size(); ++i) {
      EXPECT_GT(simulator.measure(i).size(), 200u) << name << " " << scenario.sources[i].name;
    }
  }
}

TEST(ApproachSimulator, StatesTheCovarianceOfItsNoise) {
  const ApproachScenario scenario = without_slow_errors(nominal());
  const ApproachSimulator simulator(scenario, 11);
  for (std::size_t i = 0; i < scenario.sources.size(); ++i) {
    const host::SourceMounting& mounting = simulator.true_mounting().sources[i];
    double sum = 0.0;
    int freedom = 0, rows = 0;
    for (const ApproachMeasurement& m : simulator.measure(i)) {
      if (!m.seen) continue;
      const host::SensorFromFeature truth = mounting.vehicle_from_sensor().inverse() *
                                            simulator.truth().at(m.true_time_s) * *mounting.target_from_feature();
      sum += normalised_square(m, truth, freedom);
      ++rows;
    }
    // Six standard deviations of the mean of chi-squared.
    EXPECT_NEAR(sum / freedom, 1.0, 6.0 * std::sqrt(2.0 / freedom)) << mounting.name;
    EXPECT_EQ(freedom, rows * (mounting.kind == host::SourceKind::kRing2 ? 5 : 6)) << mounting.name;
  }
}

TEST(ApproachSimulator, KeepsSourcesWithinTheirRanges) {
  const ApproachScenario scenario = without_slow_errors(nominal());
  const ApproachSimulator simulator(scenario, 4);
  for (const ApproachMeasurement& m : simulator.measure_all()) {
    const ApproachSource& source = scenario.sources[m.source];
    const double range_m = (source.T_vehicle_sensor.inverse() * simulator.truth().at(m.true_time_s).t).norm();
    EXPECT_LE(range_m, source.max_range_m);
    EXPECT_GE(range_m, source.min_range_m);
    EXPECT_NEAR(m.time_s + source.time_offset_s, m.true_time_s, 1e-9);
    EXPECT_GE(m.arrival_s, m.true_time_s + source.delay_s);
  }
}

TEST(ApproachSimulator, SameSeedSameValuesOtherSeedOthers) {
  const ApproachSimulator one(nominal(), 1), again(nominal(), 1), other(nominal(), 2);
  const auto a = one.measure(0), b = again.measure(0), c = other.measure(0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].pose.t, b[i].pose.t);
  EXPECT_NE(a[0].pose.t, c[0].pose.t);
}

TEST(ApproachSimulator, FaultsChangeOnlyTheirSourceAndTime) {
  const ApproachScenario faulty = read_approach_scenario(scenario_path("faults"));
  ApproachScenario sound = faulty;
  sound.faults.clear();
  const ApproachSimulator with(faulty, 9), without(sound, 9);
  ASSERT_EQ(with.faults().size(), 8u);
  for (std::size_t i = 0; i < faulty.sources.size(); ++i) {
    const auto a = with.measure(i), b = without.measure(i);
    ASSERT_EQ(a.size(), b.size());
    std::size_t changed = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const bool differs =
          a[k].seen && (a[k].pose.t != b[k].pose.t || a[k].pose.R != b[k].pose.R || a[k].time_s != b[k].time_s);
      changed += differs ? 1 : 0;
      EXPECT_TRUE(!differs || a[k].faulty) << faulty.sources[i].name << " " << a[k].true_time_s;
    }
    EXPECT_GT(changed, 10u) << faulty.sources[i].name;
  }
}

TEST(ApproachSimulator, TheSunBlindsTheCamerasOnly) {
  const ApproachScenario scenario = read_approach_scenario(scenario_path("sun_in_camera"));
  const ApproachSimulator simulator(scenario, 3);
  for (const ApproachMeasurement& m : simulator.measure_all()) {
    if (std::abs(m.true_time_s - 230.0) > 10.0) continue;
    EXPECT_EQ(m.seen, scenario.sources[m.source].kind == host::SourceKind::kLighthouse);
  }
}

TEST(ApproachSimulator, CalibratedMountingDiffersByItsSigmas) {
  double sum = 0.0;
  int freedom = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const ApproachSimulator simulator(nominal(), seed);
    for (std::size_t i = 0; i < 3; ++i) {
      const host::SourceMounting& stated = simulator.calibrated_mounting().sources[i];
      const host::SourceMounting& exact = simulator.true_mounting().sources[i];
      if (stated.T_vehicle_sensor.origin == host::MountingOrigin::kGiven) {
        EXPECT_EQ(stated.T_vehicle_sensor.position_m, exact.T_vehicle_sensor.position_m);
        continue;
      }
      const Vector6 error = pose_difference(exact.vehicle_from_sensor(), stated.vehicle_from_sensor());
      sum += error.cwiseAbs2().cwiseQuotient(stated.T_vehicle_sensor.covariance.diagonal()).sum();
      freedom += 6;
    }
  }
  EXPECT_NEAR(sum / freedom, 1.0, 6.0 * std::sqrt(2.0 / freedom));
}

TEST(ApproachWriter, WritesTablesThatReadBack) {
  ApproachScenario scenario = nominal();
  scenario.truth_step_s = 1.0;
  const ApproachSimulator simulator(scenario, 6);
  const test::TemporaryFolder folder;
  const ApproachSummary summary = write_approach(simulator, folder.path());
  for (std::size_t i = 0; i < scenario.sources.size(); ++i) {
    const ApproachSource& source = scenario.sources[i];
    host::SourceTable table(folder.path(source.name + ".csv"), source.kind);
    std::size_t seen = 0;
    for (const ApproachMeasurement& m : simulator.measure(i)) {
      if (!m.seen) continue;
      const auto row = table.next();
      ASSERT_TRUE(row) << source.name;
      EXPECT_EQ(row->time_s, m.time_s);
      EXPECT_EQ(row->arrival_s, m.arrival_s);
      EXPECT_EQ(row->has_turn, m.has_turn);
      EXPECT_LT((row->pose.t - m.pose.t).norm(), 1e-9);
      EXPECT_LT((row->pose.R - m.pose.R).norm(), 1e-7) << source.name;
      EXPECT_EQ(row->covariance, m.covariance);
      ASSERT_EQ(row->second.has_value(), m.second.has_value());
      EXPECT_LT(m.second ? (row->second->R - m.second->R).norm() : 0.0, 1e-7);
      ++seen;
    }
    EXPECT_FALSE(table.next());
    EXPECT_EQ(summary.seen[i], seen);
  }
  EXPECT_EQ(host::mounting_text(host::read_mounting_file(folder.path("mounting.toml"))),
            host::mounting_text(simulator.calibrated_mounting()));
  EXPECT_EQ(host::read_mounting_file(folder.path("mounting_true.toml")).sources.size(), scenario.sources.size());
}

TEST(ApproachScenario, RefusesWhatMakesNoSense) {
  const auto message = [](const std::string& text) {
    return test::error_of([&] { (void)parse_approach_scenario(text, "a.toml"); });
  };
  const std::string two = "[[source]]\nkind = \"lighthouse\"\n[[source]]\nkind = \"tof\"\n";
  EXPECT_EQ(message(two), "");
  EXPECT_NE(message("").find("source: is missing"), std::string::npos);
  EXPECT_NE(message(two + "given = true\n").find("two sources are given"), std::string::npos);
  EXPECT_NE(message(two + two).find("comes twice"), std::string::npos);
  EXPECT_NE(message(two + "rate = 3\n").find("unknown key"), std::string::npos);
  EXPECT_NE(message(two + "[[fault]]\nsource = \"slam\"\nkind = \"step\"\nat_s = 1\namount = 3\n").find("no source"),
            std::string::npos);
  EXPECT_NE(message(two + "[[fault]]\nsource = \"tof\"\nkind = \"step\"\nat_s = 1\n").find("amount: is missing"),
            std::string::npos);
  EXPECT_NE(message("[motion]\nstart_m = 1.0\nend_m = 2.0\n" + two).find("end_m"), std::string::npos);
}

}  // namespace
}  // namespace pharos::sim
