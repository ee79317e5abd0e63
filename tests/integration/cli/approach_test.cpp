// SPDX-License-Identifier: Apache-2.0
// sim approach -> calibrate mounting, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
