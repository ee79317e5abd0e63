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
  std::ofstream(config) << "[lcm]\nurl = 'udpm://1.2.3:4'\n[[target]]\nname = 'dock'\nport = '/dev/none'\n"
                        << "target_file = 'dock.csv'\n";
  ChildProcess process({DaemonUnderTest::program(), config.string()});
  EXPECT_EQ(process.wait_exit(), 1);
  EXPECT_THAT(process.text(), AllOf(HasSubstr("LCM cannot be set up"), HasSubstr("route")));
}

TEST_F(PharosdStart, WrongUsageIsExit2) {
  ChildProcess process({DaemonUnderTest::program(), "--no-such-option"});
  EXPECT_EQ(process.wait_exit(), 2);
}

}  // namespace
}  // namespace pharos::host
