// SPDX-License-Identifier: Apache-2.0
#include "host/serial/reopening_port.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "pharos/report/link_decoder.hpp"
#include "pharos/report/reporter.hpp"
#include "unit/host/serial/pty.hpp"

namespace pharos::host {
namespace {

using Attempt = ReopeningPort::Attempt;
using test::Pty;
constexpr std::int64_t kMs = 1'000'000;

/// A device name that does not change while the device is removed and replaced, like udev's links.
class DeviceName {
 public:
  DeviceName() : path_(::testing::TempDir() + "pharos_port_" + std::to_string(::getpid())) { clear(); }
  ~DeviceName() { clear(); }
  void point_to(const Pty& pty) {
    clear();
    std::filesystem::create_symlink(pty.path, path_);
  }
  void clear() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Reads until the line is gone or has no more bytes.
std::vector<report::LinkEvent> drain(ReopeningPort& port, report::LinkDecoder& link, std::int64_t now_ns) {
  std::vector<report::LinkEvent> events;
  std::array<std::uint8_t, 256> chunk{};
  while (port.is_open() && test::wait_readable(port.fd())) {
    const Transfer transfer = port.read(chunk, now_ns);
    for (std::size_t i = 0; i < transfer.bytes; ++i) {
      if (const auto event = link.push(chunk[i])) events.push_back(*event);
    }
    if (transfer.gone || transfer.bytes < chunk.size()) break;
  }
  return events;
}

TEST(ReopeningPort, TriesTwiceASecondAndReportsAReasonOnce) {
  ReopeningPort port("/dev/no-such-port", 115'200);
  EXPECT_EQ(port.try_open(0), Attempt::kFailed);
  EXPECT_EQ(port.failure().error, OpenError::kMissing);
  EXPECT_EQ(port.try_open(1 * kMs), Attempt::kNone);
  EXPECT_EQ(port.try_open(499 * kMs), Attempt::kNone);
  EXPECT_EQ(port.try_open(500 * kMs), Attempt::kStillGone);
  EXPECT_EQ(port.try_open(999 * kMs), Attempt::kNone);
  EXPECT_EQ(port.try_open(1000 * kMs), Attempt::kStillGone);
}

TEST(ReopeningPort, ReportsANewReason) {
  DeviceName name;
  ReopeningPort port(name.path(), 115'200);
  EXPECT_EQ(port.try_open(0), Attempt::kFailed);
  Pty pty;
  const auto other = SerialPort::open(pty.path, 115'200);
  ASSERT_TRUE(other.ok());
  name.point_to(pty);
  EXPECT_EQ(port.try_open(500 * kMs), Attempt::kFailed);
  EXPECT_EQ(port.failure().error, OpenError::kBusy);
}

TEST(ReopeningPort, SurvivesAnUnplugInTheMiddleOfAFrame) {
  DeviceName name;
  report::Reporter reporter;
  report::LinkDecoder link;
  ReopeningPort port(name.path(), 460'800);

  std::optional<Pty> pty(std::in_place);
  name.point_to(*pty);
  ASSERT_EQ(port.try_open(0), Attempt::kOpened);
  pty->send(reporter.report_time(1));
  EXPECT_EQ(drain(port, link, 1 * kMs).size(), 1u);
  const auto cut = reporter.report_time(2);
  pty->send(cut.first(cut.size() / 2));
  EXPECT_TRUE(drain(port, link, 2 * kMs).empty());

  pty->unplug();
  name.clear();
  drain(port, link, 3 * kMs);
  EXPECT_FALSE(port.is_open());
  EXPECT_EQ(port.times_lost(), 1u);
  link.restart();
  EXPECT_EQ(port.try_open(4 * kMs), Attempt::kNone) << "not before half a second has passed";
  EXPECT_EQ(port.try_open(503 * kMs), Attempt::kFailed);

  pty.emplace();
  name.point_to(*pty);
  ASSERT_EQ(port.try_open(1003 * kMs), Attempt::kOpened);
  EXPECT_TRUE(port.failure().message.empty());
  pty->send(reporter.report_time(3));
  const auto events = drain(port, link, 1004 * kMs);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(std::get<wire::Time>(events[0]).time_ticks, 3);
  EXPECT_EQ(link.counters().frames_lost, 1u) << "the cut frame is counted as lost";
  EXPECT_EQ(link.counters().bad_crc + link.counters().bad_stuffing, 0u) << "and nothing else is";
  EXPECT_EQ(port.times_opened(), 2u);
}

}  // namespace
}  // namespace pharos::host
