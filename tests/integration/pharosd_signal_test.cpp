// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <string>

#include "integration/pharosd_fixture.hpp"

namespace pharos::host {
namespace {

using PharosdSignal = PharosdTest;
using ::testing::HasSubstr;

// Limit of the time until the end after SIGTERM, with a margin for a busy machine.
constexpr double kStop_s = 1.0 + 4.0;

// At level trace every message is a line: a blocked log delayed the poses.
using PharosdBlockedLog = PharosdTest;
constexpr const char* kTrace = "log.level = 'trace'\n";

TEST_F(PharosdBlockedLog, HoldsUpNoPoses) {
  start("", kTrace);
  ASSERT_TRUE(poses_come(2));
  ASSERT_TRUE(daemon.process().fill_standard_error());
  EXPECT_TRUE(poses_come(20));
}

TEST_F(PharosdBlockedLog, EndsOnSigtermAllTheSame) {
  start("", kTrace);
  ASSERT_TRUE(poses_come(2));
  ASSERT_TRUE(daemon.process().fill_standard_error());
  ASSERT_TRUE(poses_come(5));
  daemon.process().signal(SIGTERM);
  // Its output must not be read meanwhile, because the test is about a pipe without reader.
  EXPECT_EQ(daemon.process().wait_exit_unread(kStop_s), 0);
  EXPECT_TRUE(daemon.wait([&] { return daemon.status() && daemon.status()->message == "stopped"; }));
}

TEST_F(PharosdSignal, GoesOnThroughSignalsThatMeanNothingToIt) {
  start();
  for (const int signal : {SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO, SIGPWR}) {
    daemon.process().signal(signal);
  }
  EXPECT_TRUE(poses_come(5));
  EXPECT_EQ(stop(), 0);
}

TEST_F(PharosdSignal, HangupTakesOverTheLogLevelAndSaysWhatNeedsARestart) {
  start();
  ASSERT_TRUE(poses_come(2));
  daemon.write_config("baud = 115200\n", "log.level = 'debug'\n");
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for("configuration read again")) << daemon.process().text();
  EXPECT_TRUE(daemon.process().wait_for("needs a restart: target dock: port: ")) << daemon.process().text();
  EXPECT_TRUE(daemon.process().wait_for("debug lighthouse/pharosd: ok")) << daemon.process().text();
  EXPECT_TRUE(poses_come(5));
}

TEST_F(PharosdSignal, HangupTakesOverThePublishLimits) {
  start();
  ASSERT_TRUE(poses_come(2));
  std::ifstream in(daemon.folder() / "pharosd.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.insert(text.find("status_rate_hz"), "max_age_s = 0.005\n");
  std::ofstream(daemon.folder() / "pharosd.toml") << text;
  const std::int64_t stale = daemon.counter("cycles_stale");
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for("configuration read again")) << daemon.process().text();
  // The pseudo-terminal's light is 8 ms and more old when its sweep is sent.
  EXPECT_TRUE(daemon.play(target, line, [&] { return daemon.counter("cycles_stale") > stale + 5; }))
      << daemon.counter("cycles_stale");
}

TEST_F(PharosdSignal, HangupWithAConfigurationThatIsWrongChangesNothing) {
  start();
  daemon.write_config("colour = 'red'\n");
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for("configuration not read again")) << daemon.process().text();
  EXPECT_THAT(daemon.process().text(), HasSubstr("target[0].colour: unknown key"));
  EXPECT_TRUE(poses_come(5));
  EXPECT_EQ(stop(), 0);
}

}  // namespace
}  // namespace pharos::host
