// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/stations/station_file.hpp"
#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "host/table/target_file.hpp"
#include "tests/unit/sim/simulated_light.hpp"
#include "tools/sim/recording_writer.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ScenarioFile : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() /
                 (std::string("pharos_sim_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(directory_);
    fs::copy_file(fs::path(PHAROS_SCENARIOS) / "target12.csv", directory_ / "target12.csv",
                  fs::copy_options::overwrite_existing);
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path write(const std::string& text) const {
    std::ofstream(directory_ / "scenario.toml") << text;
    return directory_ / "scenario.toml";
  }
  std::string refusal_of(const std::string& text) const {
    try {
      read_scenario(write(text), 1);
    } catch (const host::InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string bytes_of(const fs::path& path) const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path directory_;
};

const std::string kGood = "duration_s = 1\ntarget = 'target12.csv'\n[trajectory]\nkind = 'sine'\n";

TEST_F(ScenarioFile, ShippedScenariosAreReadAndShineOnTheirTarget) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(PHAROS_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;
    // Those of cameras and of approaches are read by their own tests.
    const std::string name = entry.path().filename().string();
    if (name.starts_with("tof_") || name.starts_with("stereo_") || name.starts_with("line_") ||
        name.starts_with("approach_")) {
      continue;
    }
    LighthouseScenario scenario = read_scenario(entry.path(), 1);
    scenario.duration_s = 0.5;
    LighthouseSimulator simulator(scenario, 1);
    EXPECT_GT(all_pulses(simulator).size(), 200u) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

TEST_F(ScenarioFile, DefaultsOfTheFileAreThoseOfTheProgram) {
  const LighthouseScenario scenario = read_scenario(write(kGood), 1);
  EXPECT_EQ(scenario.noise.sigma_arcsec, NoiseScenario{}.sigma_arcsec);
  EXPECT_EQ(scenario.light.max_incidence_deg, 60.0);
  ASSERT_EQ(scenario.stations.size(), 1u);
  EXPECT_EQ(scenario.stations[0].mode, StationMode::kA);
  EXPECT_EQ(scenario.target.size(), 12u);
}

TEST_F(ScenarioFile, RefusalsNameFileLineAndKey) {
  EXPECT_EQ(refusal_of(kGood), "no error");
  EXPECT_THAT(refusal_of(kGood + "[noise]\nsigma = 8\n"),
              AllOf(HasSubstr("scenario.toml:6:"), HasSubstr("noise.sigma")));
  EXPECT_THAT(refusal_of(kGood + "[noise]\nrho = 1.2\n"), AllOf(HasSubstr("scenario.toml:6:"), HasSubstr("noise.rho")));
  EXPECT_THAT(refusal_of(kGood + "[clock]\nwrap32 = 1\n"), AllOf(HasSubstr(":6:"), HasSubstr("clock.wrap32")));
  EXPECT_THAT(refusal_of("target = 'target12.csv'\n"), HasSubstr("duration_s: is missing"));
  EXPECT_THAT(refusal_of("duration_s = 1\ntarget = 'target12.csv'\n"), HasSubstr("trajectory"));
  EXPECT_THAT(refusal_of("duration_s = 1\ntarget = 'absent.csv'\n[trajectory]\nkind = 'sine'\n"),
              HasSubstr("absent.csv"));
  EXPECT_THAT(refusal_of(kGood + "[[station]]\nid = 'xyz'\n"), AllOf(HasSubstr(":6:"), HasSubstr("station[0].id")));
  EXPECT_THAT(refusal_of(kGood + "[[station]]\nmode = 'A'\n[[station]]\n"), HasSubstr("must be in mode B"));
  EXPECT_THAT(refusal_of(kGood + "[[faults.reflection]]\nsensors = [31]\n"), HasSubstr("no sensor 31"));
  EXPECT_THAT(refusal_of(kGood + "[faults]\nstale_pulses = 3\nstale_s = -5\n"), HasSubstr("below zero"));
  EXPECT_THAT(
      refusal_of(
          "duration_s = 1\ntarget = 'target12.csv'\n[trajectory]\nkind = 'rest'\nposes = [[1, 1, 0, 0, 0, 0, 2]]\n"),
      AllOf(HasSubstr(":5:"), HasSubstr("unit quaternion")));
  EXPECT_THAT(refusal_of("duration_s = 1\ntarget = 'target12.csv'\n[trajectory]\nkind = 'sine'\nspeed_m_s = 2\n"),
              AllOf(HasSubstr(":5:"), HasSubstr("trajectory.speed_m_s: unknown key")));
}

TEST_F(ScenarioFile, RecordingsHoldPulsesTruthTargetsStationsAndFaults) {
  LighthouseScenario scenario = read_scenario(write(kGood + "[[station]]\n[faults]\nmissed_hit_rate = 0.1\n"), 5);
  scenario.errors = ErrorScenario::workshop();
  const RecordingSummary summary = write_recording(scenario, 5, directory_ / "out");
  host::EdgesReader edges{host::ByteSource((directory_ / "out/edges.csv.gz").string())};
  LighthouseSimulator simulator(scenario, 5);
  std::uint64_t pulses = 0;
  while (const auto pulse = edges.next()) {
    const auto expected = simulator.next();
    ASSERT_TRUE(expected.has_value());
    EXPECT_EQ(pulse->rise_ticks, expected->rise_ticks);
    EXPECT_EQ(pulse->fall_ticks, expected->fall_ticks);
    ++pulses;
  }
  EXPECT_EQ(pulses, summary.pulses);
  EXPECT_FALSE(simulator.next().has_value());

  const Target nominal = host::read_target((directory_ / "out/target.csv").string()).target;
  const Target built = host::read_target((directory_ / "out/target_true.csv").string()).target;
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    EXPECT_EQ(nominal[i].position_m, scenario.target[i].position_m);
    EXPECT_EQ(built[i].position_m, simulator.true_target()[i].position_m);
    EXPECT_GT((built[i].position_m - nominal[i].position_m).norm(), 1e-5);
    EXPECT_LT((built[i].position_m - nominal[i].position_m).norm(), 3e-3);
  }

  std::ifstream truth(directory_ / "out/truth.csv");
  std::string line;
  std::getline(truth, line);
  EXPECT_EQ(line, "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m");
  double expected_time = 1.0;
  while (std::getline(truth, line)) {
    double v[9];
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3, v + 4, v + 5,
                          v + 6, v + 7, v + 8),
              9);
    EXPECT_NEAR(v[0], expected_time, 1e-12);
    const LighthouseFromBody T = simulator.truth(0, v[0]);
    EXPECT_EQ(v[2], T.quaternion().w());
    EXPECT_EQ(v[8], T.t.z());
    expected_time += 0.001;
  }
  EXPECT_NEAR(expected_time, 2.0, 0.0015);
  const auto announced = host::read_station_file((directory_ / "out/stations.toml").string());
  const auto actual = host::read_station_file((directory_ / "out/stations_true.toml").string());
  ASSERT_EQ(announced.size(), simulator.stations().size());
  ASSERT_EQ(actual.size(), announced.size());
  for (std::size_t i = 0; i < announced.size(); ++i) {
    const SimulatedStation& station = simulator.stations()[i];
    EXPECT_EQ(announced[i].id, station.announced.id);
    EXPECT_EQ(announced[i].calibration.rotor[1].tilt_rad, station.announced.rotor[1].tilt_rad);
    EXPECT_EQ(actual[i].calibration.rotor[0].phase_rad, station.true_errors[0].phase_rad);
    EXPECT_EQ(actual[i].calibration.rotor[1].gibbous_phase_rad, station.true_errors[1].gibbous_phase_rad);
  }
  EXPECT_THAT(bytes_of(directory_ / "out/faults.csv"), HasSubstr("missed_hit"));
}

TEST_F(ScenarioFile, SameSeedSameBytes) {
  const LighthouseScenario scenario = read_scenario(fs::path(PHAROS_SCENARIOS) / "recordings_like.toml", 9);
  write_recording(scenario, 9, directory_ / "a");
  write_recording(scenario, 9, directory_ / "b");
  for (const char* name :
       {"edges.csv.gz", "truth.csv", "target_true.csv", "stations.toml", "stations_true.toml", "faults.csv"}) {
    EXPECT_EQ(bytes_of(directory_ / "a" / name), bytes_of(directory_ / "b" / name)) << name;
  }
  // Stamps of the wrapped counter have 32 bits, although the recording passes the wrap.
  host::ByteSource source((directory_ / "a/edges.csv.gz").string());
  host::EdgesReader edges(std::move(source));
  std::int64_t minimum = INT64_MAX;
  std::int64_t greatest = 0;
  while (const auto pulse = edges.next()) {
    minimum = std::min(minimum, pulse->rise_ticks);
    greatest = std::max(greatest, pulse->rise_ticks);
  }
  EXPECT_GT(greatest - minimum, std::int64_t{19} * 50'000'000) << "the reader unwraps: the span is the duration";
}

TEST_F(ScenarioFile, AnOutputThatCannotBeMadeIsRefused) {
  const LighthouseScenario scenario = read_scenario(write(kGood), 1);
  std::ofstream(directory_ / "taken") << "a file";
  EXPECT_THROW(write_recording(scenario, 1, directory_ / "taken"), host::InputError);
}

}  // namespace
}  // namespace pharos::sim
