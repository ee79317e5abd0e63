// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "host/serial/serial_port.hpp"
#include "integration/pharosd_fixture.hpp"

namespace pharos::host {
namespace {

using PharosdPort = PharosdTest;
using ::testing::HasSubstr;

TEST_F(PharosdPort, AMissingPortIsWaitedFor) {
  daemon.write_config();
  daemon.start();
  ASSERT_TRUE(daemon.wait([&] { return daemon.source() != nullptr; }));
  EXPECT_EQ(daemon.source()->state, "gone");
  EXPECT_THAT(daemon.source()->message, HasSubstr("no such device"));
  EXPECT_EQ(daemon.status()->state, "error");
  daemon.plug_in(line);
  EXPECT_TRUE(poses_come(5));
}

TEST_F(PharosdPort, UnpluggedInTheMiddleOfAFrameItComesBackWhenPluggedIn) {
  daemon.write_config();
  {
    PseudoTerminal first;
    daemon.plug_in(first);
    daemon.start();
    ASSERT_TRUE(poses_come(5, first));
    std::vector<std::uint8_t> half = target.hello("cut in the middle");
    half.resize(half.size() / 2);
    first.write(half);
    daemon.pull_out();
  }
  ASSERT_TRUE(daemon.process().wait_for("was unplugged")) << daemon.process().text();
  ASSERT_TRUE(daemon.wait([&] { return daemon.source() != nullptr && daemon.source()->state == "gone"; }));
  PseudoTerminal other;  // another device number, as after a real replug
  daemon.plug_in(other);
  ASSERT_TRUE(poses_come(5, other));
  EXPECT_EQ(daemon.counter("port.lost"), 1);
}

TEST_F(PharosdPort, ABusyPortIsNamedAndTakenOnceFree) {
  daemon.plug_in(line);
  daemon.write_config();
  {
    const auto held = SerialPort::open(line.path(), 460'800);
    ASSERT_TRUE(held.ok());
    daemon.start();
    EXPECT_TRUE(daemon.process().wait_for("in use by another program")) << daemon.process().text();
    ASSERT_TRUE(daemon.wait([&] { return daemon.source() != nullptr && daemon.source()->state == "error"; }));
    EXPECT_THAT(daemon.source()->message, HasSubstr("in use by another program"));
  }
  EXPECT_TRUE(poses_come(5));
}

TEST_F(PharosdPort, WhatIsNoTerminalIsSaidToBeNone) {
  daemon.write_config();
  std::ofstream(daemon.port()) << "a file";
  daemon.start();
  EXPECT_TRUE(daemon.process().wait_for("not a terminal")) << daemon.process().text();
  ASSERT_TRUE(daemon.wait([&] { return daemon.source() != nullptr; }));
  EXPECT_EQ(daemon.source()->state, "error");
}

TEST_F(PharosdPort, AnotherProtocolVersionIsReportedOnceAndInTheStatus) {
  start();
  ASSERT_TRUE(daemon.process().wait_for("is open"));
  for (std::uint16_t i = 0; i < 5; ++i) line.write(frame_of_unsupported_version(7, i));
  ASSERT_TRUE(daemon.wait([&] { return daemon.source() != nullptr && daemon.source()->state == "error"; }))
      << daemon.process().text();
  EXPECT_THAT(daemon.source()->message, HasSubstr("speaks version 7"));
  const std::string& log = daemon.process().text();
  const std::size_t first = log.find("speaks version 7");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("speaks version 7", first + 1), std::string::npos) << "told more than once";
}

}  // namespace
}  // namespace pharos::host
