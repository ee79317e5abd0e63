// SPDX-License-Identifier: Apache-2.0
// sim approach -> calibrate mounting, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

std::string approach_scenario(const std::string& name) {
  return std::string(PHAROS_SCENARIOS) + "/approach_" + name + ".toml";
}

TEST(CliApproach, MountingIsCalibratedFromASimulatedMinute) {
  const Folder folder;
  const std::string dir = folder.path("minute");
  const Outcome sim = pharos("sim approach " + approach_scenario("mounting") + " --seed 3 --output " + dir);
  ASSERT_EQ(sim.exit_code, 0) << sim.err;
  EXPECT_THAT(sim.err, HasSubstr("tof.csv with"));
  const std::string tables = dir + "/lighthouse.csv " + dir + "/tof.csv camera:ring2=" + dir + "/ring2.csv";
  const Outcome run = pharos("calibrate mounting " + tables + " --given lighthouse --output " + folder.path("m.toml") +
                             " --report " + folder.path("m.html") + " --rig bench");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("source,parameter,value,sigma"));
  EXPECT_THAT(run.out, HasSubstr("camera,time_offset_ms,"));
  EXPECT_THAT(run.err,
              HasSubstr("camera: not told by this recording, left at its prior: rotation of T_target_feature"));
  const Outcome again =
      pharos("calibrate mounting " + tables + " --given lighthouse --prior " + folder.path("m.toml") + " --output -");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("rig = \"bench\""));
}

// A few seconds of every sensor's raw data, each through its own estimator: the poses are those of one truth.
TEST(CliApproach, RawDataOfAllSensorsFuseToTheTruth) {
  const Folder folder;
  const std::string dir = folder.path("raw");
  const Outcome sim = pharos("sim approach " + approach_scenario("nominal") +
                             " --seed 3 --level images --target " PHAROS_SCENARIOS
                             "/target12.csv --from 160 --to 164.1 "
                             "--rate tof=5 --rate ring2=0.5 --rate slam=0.5 --output " +
                             dir);
  ASSERT_EQ(sim.exit_code, 0) << sim.err;
  EXPECT_TRUE(std::filesystem::exists(dir + "/slam/left/1000162000000000.png"));
  const auto table = [&](const std::string& name, const std::string& command) {
    const Outcome run = pharos(command + " --covariance --output " + dir + "/" + name + ".csv");
    EXPECT_EQ(run.exit_code, 0) << name << ": " << run.err;
  };
  const std::string light = dir + "/lighthouse/";
  table("lighthouse", "track " + light + "edges.csv.gz --target " + light + "target_surveyed.csv --calibration " +
                          light + "stations_true.toml");
  table("tof", "tof " + dir + "/tof --camera " + dir + "/tof/camera.toml");
  table("ring2", "circles " + dir + "/ring2 --rig " + dir + "/ring2/rig.toml");
  const Outcome run = pharos("fuse " + dir + "/lighthouse.csv " + dir + "/tof.csv " + dir + "/ring2.csv --mounting " +
                             dir + "/mounting.toml --truth " + dir + "/truth.csv --by-range " + dir + "/range.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, Row> sources;
  for (const Row& row : rows_of(content_of(dir + "/range.csv"))) sources[row.at("source")] = row;
  ASSERT_EQ(sources.size(), 4U);
  for (const auto& [name, row] : sources) {
    EXPECT_LT(std::stod(row.at("rms_tilt_deg")), 1.0) << name;
    EXPECT_LT(std::stod(row.at("rms_mm")), 20.0) << name;
  }
  EXPECT_GE(std::stoi(sources.at("tof").at("count")), 15);
  EXPECT_GE(std::stoi(sources.at("ring2").at("count")), 3);

  // One pair that cannot be read costs its own row, not those of the others.
  const std::size_t pairs = rows_of(content_of(dir + "/ring2.csv")).size();
  std::ofstream(dir + "/ring2/1000162000000000_right.png") << "no image";
  const Outcome damaged = pharos("circles " + dir + "/ring2 --rig " + dir + "/ring2/rig.toml");
  EXPECT_EQ(damaged.exit_code, 0) << damaged.err;
  EXPECT_EQ(rows_of(damaged.out).size(), pairs - 1);
  EXPECT_THAT(damaged.err, HasSubstr("1000162000000000_right.png"));
  EXPECT_THAT(damaged.err, HasSubstr("left out"));
}

TEST(CliApproach, FaultsOfPosesAreNotSimulatedInImages) {
  const Folder folder;
  const Outcome run = pharos("sim approach " + approach_scenario("faults") +
                             " --level images --target " PHAROS_SCENARIOS "/target12.csv --output " + folder.path("x"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("use --level measurements"));
}

TEST(CliApproach, WhatCannotBeCalibratedIsOneLine) {
  const Folder folder;
  const std::string table =
      folder.write("lighthouse.csv",
                   "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n0.5,1,0,0,0,0,0,1,0.1,1,ok\n");
  const auto error = [&](const std::string& arguments) {
    const Outcome run = pharos("calibrate mounting " + arguments + " --output " + folder.path("m.toml"));
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
    return run.err;
  };
  EXPECT_THAT(error(table + " --given lighthouse"), HasSubstr("one source alone"));
  EXPECT_THAT(error(table + " --given tof"), HasSubstr("no table has this name"));
  EXPECT_THAT(error(table + " " + table + " --given lighthouse"), HasSubstr("comes twice"));
  EXPECT_THAT(error("sonar=" + table + " --given sonar"), HasSubstr("what kind of source"));
  EXPECT_THAT(error(table + " tof=" + table + " --given lighthouse"), HasSubstr("fewer than 30 poses"));
}

}  // namespace
}  // namespace pharos::cli_test
