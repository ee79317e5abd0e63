// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTarget = "sensor,x_m,y_m,z_m\n0,-0.015,0.0075,0\n1,-0.015,-0.0075,0\n2,0.015,0.0075,0\n";
constexpr const char* kSweepsHeader = "time_s,station,axis,sensor,theta_rad\n";

TEST(CliStations, WhatCannotBeCalibratedIsOneLine) {
  const Folder folder;
  const std::string target = folder.write("target.csv", kTarget);
  const auto error = [&](const std::string& sweeps, const std::string& more = "") {
    const Outcome run = pharos("calibrate stations " + folder.write("sweeps.csv", sweeps) + " --target " + target +
                               " --output " + folder.path("out.toml") + more);
    EXPECT_EQ(run.exit_code, 2) << sweeps;
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  std::string one = kSweepsHeader;
  for (int k = 0; k < 300; ++k) one += std::to_string(0.01 * k) + ",0,x,0,1.5\n";
  EXPECT_THAT(error(one), HasSubstr("at least two are needed"));
  EXPECT_THAT(error(kSweepsHeader), HasSubstr("at least two are needed"));
  EXPECT_THAT(error("a,b\n1,2\n"), HasSubstr("column"));
  EXPECT_THAT(error(std::string(kSweepsHeader) + "0.0,0,x,0,1.5\n0.1,0,a,0,0.1\n"), HasSubstr("generation 1"));
  EXPECT_THAT(error(std::string(kSweepsHeader) + "0.0,0,x,0,nan\n"), HasSubstr("theta_rad"));
  EXPECT_THAT(error(one, " --up " + folder.write("imu.csv", "time_s,acc_x_m_s2,acc_y_m_s2,acc_z_m_s2\n")),
              HasSubstr("no accelerations"));
  EXPECT_THAT(error(one, " --stations " + folder.write("none.toml", "x = 1\n")), HasSubstr("none.toml"));
}

}  // namespace
}  // namespace pharos::cli_test
