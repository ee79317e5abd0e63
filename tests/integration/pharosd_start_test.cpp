// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "integration/pharosd_fixture.hpp"

namespace pharos::host {
namespace {

using PharosdStart = PharosdTest;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(PharosdStart, StopsCleanlyOnSigtermWithALastStatus) {
  start();
  ASSERT_TRUE(poses_come(5));
  EXPECT_EQ(stop(), 0);
  EXPECT_THAT(daemon.process().text(), HasSubstr("stopped"));
  EXPECT_TRUE(daemon.wait([&] { return daemon.status() && daemon.status()->message == "stopped"; }));
}

TEST_F(PharosdStart, CheckPrintsWhatItUnderstoodAndEndsWith0) {
  daemon.write_config();
  ChildProcess check({DaemonUnderTest::program(), "--check", (daemon.folder() / "pharosd.toml").string()});
  EXPECT_EQ(check.wait_exit(), 0);
  EXPECT_THAT(check.text(), AllOf(HasSubstr("target dock"), HasSubstr("sensors: 6"), HasSubstr(daemon.url())));
}

TEST_F(PharosdStart, AnUnknownKeyIsOneLineAndExit2) {
  daemon.write_config("colour = 'red'\n");
  ChildProcess process({DaemonUnderTest::program(), (daemon.folder() / "pharosd.toml").string()});
  EXPECT_EQ(process.wait_exit(), 2);
  EXPECT_THAT(process.text(), AllOf(HasSubstr("pharosd.toml:"), HasSubstr("target[0].colour: unknown key")));
  EXPECT_EQ(std::count(process.text().begin(), process.text().end(), '\n'), 1);
}

TEST_F(PharosdStart, ASensorTwiceIsExit2) {
  daemon.write_config();
  std::ofstream(daemon.folder() / "dock.csv", std::ios::app) << "3,0,0,1\n";
  ChildProcess process({DaemonUnderTest::program(), (daemon.folder() / "pharosd.toml").string()});
  EXPECT_EQ(process.wait_exit(), 2);
  EXPECT_THAT(process.text(), AllOf(HasSubstr("dock.csv"), HasSubstr("line 8"), HasSubstr("sensor 3")));
}

TEST_F(PharosdStart, WithoutLcmItSaysWhatToDoAndEndsWith1) {
  const auto config = daemon.write_config();
  std::ofstream(config) << "[lcm]\nurl = 'file:///no/such/folder/log?mode=w'\n[[target]]\nname = 'dock'\n"
                        << "port = '/dev/none'\ntarget_file = 'dock.csv'\n";
  ChildProcess process({DaemonUnderTest::program(), config.string()});
  EXPECT_EQ(process.wait_exit(), 1);
  EXPECT_THAT(process.text(), AllOf(HasSubstr("LCM cannot be set up"), HasSubstr("route")));
}

// Errors found by --check prevent the daemon's start as well.
TEST_F(PharosdStart, WhatIsNotUnderstoodAroundTheConfigurationIsExit2WithAndWithoutCheck) {
  const std::string second = "[[target]]\nname = 'free'\ntarget_file = 'dock.csv'\nport = ";
  daemon.plug_in(line);
  for (const std::string& bad : {second + "'" + line.path() + "'\n", second + "'replay:dock.csv'\n"}) {
    const std::string config = daemon.write_config(bad).string();
    ChildProcess check({DaemonUnderTest::program(), "--check", config});
    ChildProcess process({DaemonUnderTest::program(), config});
    EXPECT_EQ(check.wait_exit(), 2);
    EXPECT_EQ(process.wait_exit(), 2);
    EXPECT_THAT(check.text(), AllOf(HasSubstr("pharosd.toml:"), HasSubstr("target[1].port: ")));
    EXPECT_EQ(process.text(), check.text());
  }
}

TEST_F(PharosdStart, ADirectoryThatCannotBeWrittenFailsTheCheckAndIsReportedAtTheStart) {
  const std::string config = daemon.write_config("[recording]\ndirectory = 'dock.csv'\n").string();
  daemon.plug_in(line);
  ChildProcess check({DaemonUnderTest::program(), "--check", config});
  EXPECT_EQ(check.wait_exit(), 2);
  EXPECT_THAT(check.text(), HasSubstr("recording.directory: "));
  daemon.start();
  EXPECT_TRUE(daemon.process().wait_for("recording.directory: ")) << daemon.process().text();
  EXPECT_TRUE(poses_come(5)) << "poses need no disk";
}

TEST_F(PharosdStart, WrongUsageIsExit2) {
  ChildProcess process({DaemonUnderTest::program(), "--no-such-option"});
  EXPECT_EQ(process.wait_exit(), 2);
}

}  // namespace
}  // namespace pharos::host
