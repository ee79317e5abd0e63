// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/port_feed.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "support/temporary_folder.hpp"
#include "unit/host/daemon/captured_log.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/serial/pty.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

class PortFeedTest : public ::testing::Test {
 protected:
  // Connects a serial device, lets the daemon open it, and disconnects it.
  void flap() {
    test::Pty pty;
    fs::create_symlink(pty.path, name_);
    clock_.advance(kReopenPeriod_ns);
    feed_.attend(clock_.monotonic_ns());
    fs::remove(name_);
    pty.unplug();
    while (feed_.state() == SourceState::kOk) loop_.turn(1000);
  }
  std::int64_t count(const std::string& name) const {
    for (const NamedCount& count : feed_.counters()) {
      if (count.name == name) return count.value;
    }
    return -1;
  }

  test::CapturedLog log_;
  pharos::test::TemporaryFolder folder_;
  fs::path name_ = folder_.path() / "port";
  EventLoop loop_;
  int lost_ = 0;
  test::ManualClock clock_;
  PortFeed feed_{loop_,   clock_,
                 "dock",  name_.string(),
                 460'800, {[](std::span<const std::uint8_t>, const Arrival&) {}, [this] { ++lost_; }, [] {}}};
};

TEST_F(PortFeedTest, AReconnectedPlugIsLoggedInFull) {
  flap();
  flap();
  EXPECT_EQ(log_.lines("is open").size(), 2u);
  EXPECT_EQ(log_.lines("was unplugged").size(), 2u);
  EXPECT_EQ(count("port.log_lines_held_back"), 0);
}

TEST_F(PortFeedTest, AFlappingPortDoesNotFillTheLog) {
  constexpr int kTimes = 40;
  for (int i = 0; i < kTimes; ++i) flap();
  EXPECT_EQ(lost_, kTimes);
  EXPECT_EQ(count("port.lost"), kTimes) << "every one is counted";
  const std::size_t told = log_.lines("dock: ").size();
  EXPECT_LE(told, 30u);  // of 80: attend()'s clock advances by 20 s, a little over two periods
  EXPECT_EQ(count("port.log_lines_held_back"), 2 * kTimes - static_cast<std::int64_t>(told));
}

}  // namespace
}  // namespace pharos::host
