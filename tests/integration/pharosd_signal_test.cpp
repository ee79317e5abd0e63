// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "host/runtime/now.hpp"
#include "integration/pharosd_fixture.hpp"

namespace pharos::host {
namespace {

using PharosdSignal = PharosdTest;
using ::testing::HasSubstr;

// Limit of the time until the end after SIGTERM, with a margin for a busy machine.
constexpr double kStop_s = 1.0 + 4.0;

std::string content_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

int times_in(const std::string& text, const std::string& words) {
  int times = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++times;
  return times;
}

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

// Sends signals without end, faster than the configuration can be read again.
class SignalStorm {
 public:
  explicit SignalStorm(const ChildProcess& process)
      : thread_([this, &process] {
          while (!over_) {
            for (const int signal : {SIGHUP, SIGUSR1, SIGUSR2, SIGALRM, SIGPIPE, SIGCHLD, SIGHUP}) {
              process.signal(signal);
              ++sent_;
            }
          }
        }) {}
  ~SignalStorm() {
    over_ = true;
    thread_.join();
  }
  int sent() const { return sent_; }

 private:
  std::atomic<bool> over_ = false;
  std::atomic<int> sent_ = 0;
  std::thread thread_;
};

TEST_F(PharosdSignal, AStormOfSignalsCostsNoPoseAndHoldsUpNoEnd) {
  constexpr int kSignals = 300'000;
  daemon.plug_in(line);
  const std::string config = daemon.write_config();
  std::string text = content_of(config);
  text.insert(text.find("status_rate_hz"), "max_age_s = 5.0\n");  // a busy machine is not what is tested
  std::ofstream(config) << text;
  daemon.start();
  ASSERT_TRUE(poses_come(60));
  daemon.wait([] { return false; }, 0.3);
  const std::size_t before = daemon.valid_poses();
  std::size_t sweeps = 0;
  const std::int64_t begun_ns = monotonic_now_ns();
  const SignalStorm storm(daemon.process());
  const bool played = daemon.play(target, line, [&] {
    if (storm.sent() >= kSignals) return true;
    sweeps += 2;
    return false;
  });
  EXPECT_TRUE(played) << storm.sent();
  EXPECT_TRUE(daemon.wait([&] { return daemon.valid_poses() >= before + sweeps; }))
      << daemon.valid_poses() - before << " of " << sweeps;
  daemon.process().signal(SIGTERM);
  EXPECT_EQ(daemon.process().wait_exit(kStop_s), 0) << daemon.process().text();
  // Else poses wait for one reading after another; it was some 7,000 a second.
  const double lasted_s = static_cast<double>(monotonic_now_ns() - begun_ns) * 1e-9;
  EXPECT_LE(times_in(daemon.process().text(), "configuration read again"), 2.0 + 2.0 * lasted_s);
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
  std::string text = content_of(daemon.folder() / "pharosd.toml");
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
