// SPDX-License-Identifier: Apache-2.0
// From what is connected to a running daemon: `pharos devices`, `pharos init`, `pharosd --check`, the table at its
// start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "integration/daemon_under_test.hpp"
#include "integration/pseudo_terminal.hpp"
#include "pharos/report/reporter.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSensors = "sensor,x_m,y_m,z_m\n0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n3,0,0,0.1\n";

TEST(Setup, DevicesNamesTheBoardThatGreets) {
  const PseudoTerminal line;
  wire::Hello hello;
  hello.board = wire::Text<24>("ep4ce10");
  hello.unique_id = 0xA1B2C3D;
  hello.sensors = 0xFFF;
  report::Reporter reporter;
  line.write(reporter.send(hello));
  ChildProcess devices({PHAROS, "devices", line.path(), "--no-cameras", "--seconds", "20"});
  EXPECT_EQ(devices.wait_exit(30.0), 0);
  EXPECT_THAT(devices.text(), HasSubstr("serial," + line.path() + ",ok,ep4ce10,0A1B2C3D,0.0.0,12,,"));
}

TEST(Setup, DevicesWithoutABoardEndsWith1InBoundedTime) {
  const PseudoTerminal line;
  ChildProcess devices({PHAROS, "devices", line.path(), "--no-cameras", "--seconds", "0.2"});
  EXPECT_EQ(devices.wait_exit(30.0), 1);
  EXPECT_THAT(devices.text(), HasSubstr("," + line.path() + ",silent,"));
}

TEST(Setup, WhatInitWritesPassesTheCheckAndTheDaemonTellsItAtItsStart) {
  const test::TemporaryFolder folder;
  const PseudoTerminal line;
  const std::string config = folder.path("pharosd.toml");
  ChildProcess init({PHAROS, "init", "--port", line.path(), "--target", "dock", "--target-file",
                     folder.write("dock.csv", kSensors), "--output", config});
  ASSERT_EQ(init.wait_exit(30.0), 0) << init.text();
  ChildProcess check({DaemonUnderTest::program(), "--check", config});
  EXPECT_EQ(check.wait_exit(30.0), 0) << check.text();
  EXPECT_THAT(check.text(), AllOf(HasSubstr("target dock"), HasSubstr(line.path())));
  std::ofstream(config, std::ios::app) << "[lcm]\nurl = 'file://" + folder.path("log") + "?mode=w'\n";
  ChildProcess daemon({DaemonUnderTest::program(), config});
  EXPECT_TRUE(daemon.wait_for("started", 20.0)) << daemon.text();
  EXPECT_THAT(daemon.text(), AllOf(HasSubstr("SOURCE"), HasSubstr("lighthouse/pharosd  dock    " + line.path()),
                                   HasSubstr("PHAROS_LIGHTHOUSE_POSE")));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait_exit(20.0), 0);
}

TEST(Setup, InitKeepsAnExistingFileAndWritesNothingThatDoesNotWork) {
  const test::TemporaryFolder folder;
  const std::string config = folder.write("pharosd.toml", "mine");
  const std::string sensors = folder.write("dock.csv", kSensors);
  ChildProcess kept({PHAROS, "init", "--port", "/dev/none", "--target-file", sensors, "--output", config});
  EXPECT_EQ(kept.wait_exit(30.0), 2);
  EXPECT_THAT(kept.text(), HasSubstr("pharosd.toml: exists"));
  ChildProcess wrong(
      {PHAROS, "init", "--port", "/dev/none", "--target-file", folder.path("gone.csv"), "--force", "--output", config});
  EXPECT_EQ(wrong.wait_exit(30.0), 2);
  EXPECT_THAT(wrong.text(), HasSubstr("gone.csv"));
  ChildProcess incomplete({PHAROS, "init", "--port", "/dev/none", "--force", "--output", config});
  EXPECT_EQ(incomplete.wait_exit(30.0), 1);
  EXPECT_THAT(incomplete.text(), HasSubstr("left out: the file of its sensors' positions is missing"));
  std::ifstream file(config);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(content, "mine");
}

TEST(Setup, InitAsksForEveryEntry) {
  const test::TemporaryFolder folder;
  const std::string answers =
      folder.write("answers", "/dev/ttyUSB9\ndock\n" + folder.write("dock.csv", kSensors) + "\n-\n");
  const std::string config = folder.path("pharosd.toml");
  ChildProcess init(
      {"/bin/sh", "-c", std::string(PHAROS) + " init --ask --no-search --output " + config + " < " + answers});
  EXPECT_EQ(init.wait_exit(30.0), 0) << init.text();
  EXPECT_THAT(init.text(),
              AllOf(HasSubstr("Serial port of the target's board"), HasSubstr("target dock on /dev/ttyUSB9")));
  ChildProcess check({DaemonUnderTest::program(), "--check", config});
  check.wait_exit(30.0);
  EXPECT_THAT(check.text(), HasSubstr("target dock"));
}

}  // namespace
}  // namespace pharos::host
