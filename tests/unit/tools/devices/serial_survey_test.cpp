// SPDX-License-Identifier: Apache-2.0
#include "tools/devices/serial_survey.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "host/serial/serial_port.hpp"
#include "pharos/report/reporter.hpp"
#include "tests/integration/pseudo_terminal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace pharos::tools {
namespace {

using host::PseudoTerminal;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kBaud = 460'800;
constexpr milliseconds kLong{20'000}, kShort{200};

std::vector<std::uint8_t> greeting() {
  wire::Hello hello;
  hello.firmware_minor = 2;
  hello.firmware_patch = 7;
  hello.sensors = 0xFFF;
  hello.unique_id = 0xA1B2C3D;
  hello.board = wire::Text<24>("ep4ce10");
  hello.target = wire::Text<24>("target12");
  report::Reporter reporter;
  const auto bytes = reporter.send(hello);
  return {bytes.begin(), bytes.end()};
}

// The line is opened first by the survey, which clears what was sent before: a board greets again and again.
PortFinding survey_one(const PseudoTerminal& line, const std::vector<std::uint8_t>& bytes, milliseconds limit) {
  line.write(bytes);
  return survey_ports({line.path()}, kBaud, limit).front();
}

TEST(SerialSurvey, ABoardThatGreetsIsNamed) {
  const PseudoTerminal line;
  std::vector<std::uint8_t> bytes = {1, 2, 3, 0, 255};
  for (const std::uint8_t byte : greeting()) bytes.push_back(byte);
  const PortFinding found = survey_one(line, bytes, kLong);
  EXPECT_EQ(found.status, "ok");
  ASSERT_TRUE(found.hello);
  EXPECT_EQ(found.hello->board.view(), "ep4ce10");
  EXPECT_EQ(version_of(*found.hello), "0.2.7");
  EXPECT_EQ(serial_of(*found.hello), "0A1B2C3D");
  EXPECT_EQ(sensors_of(*found.hello), 12);
}

TEST(SerialSurvey, WhatDoesNotGreetIsToldApart) {
  const PseudoTerminal silent, other;
  other.write(std::vector<std::uint8_t>(100, 'x'));
  PseudoTerminal clock;
  report::Reporter reporter;
  const auto time = reporter.report_time(5);
  clock.write({time.data(), time.size()});
  const auto found =
      survey_ports({silent.path(), other.path(), clock.path(), "/dev/null", "/nowhere/tty"}, kBaud, kShort);
  std::vector<std::string> statuses;
  for (const PortFinding& finding : found) {
    statuses.push_back(finding.status);
    EXPECT_FALSE(finding.hello);
    EXPECT_NE(finding.message, "");
  }
  EXPECT_THAT(statuses, ElementsAre("silent", "unknown_data", "no_hello", "error", "missing"));
}

TEST(SerialSurvey, APortInUseIsBusy) {
  const PseudoTerminal line;
  const auto held = host::SerialPort::open(line.path(), kBaud);
  ASSERT_TRUE(held);
  EXPECT_EQ(survey_ports({line.path()}, kBaud, kShort).front().status, "busy");
}

TEST(SerialSurvey, AnUnpluggedBoardIsMissing) {
  auto line = std::make_unique<PseudoTerminal>();
  const std::string path = line->path();
  const test::TemporaryFolder folder;
  std::vector<std::uint8_t> bytes(100, 'x');
  line->write(bytes);
  line.reset();
  EXPECT_EQ(survey_ports({path}, kBaud, kShort).front().status, "missing");
}

TEST(SerialSurvey, EachAdaptorIsListedOnceUnderItsLastingName) {
  const test::TemporaryFolder dev;
  std::filesystem::create_directories(dev.path("serial/by-id"));
  for (const char* name : {"ttyUSB0", "ttyUSB1", "ttyACM0", "ttyS0", "null"}) dev.write(name, "");
  std::filesystem::create_symlink("ttyUSB1", dev.path("pharos-A50285BI"));
  std::filesystem::create_symlink("../../ttyUSB1", dev.path("serial/by-id/usb-FTDI_A50285BI"));
  std::filesystem::create_symlink("../../ttyACM0", dev.path("serial/by-id/usb-board"));
  std::filesystem::create_symlink("../../gone", dev.path("serial/by-id/usb-gone"));
  EXPECT_THAT(serial_ports(dev.path()),
              ElementsAre(dev.path("pharos-A50285BI"), dev.path("serial/by-id/usb-board"), dev.path("ttyUSB0")));
  EXPECT_TRUE(serial_ports(dev.path("nothing")).empty());
}

}  // namespace
}  // namespace pharos::tools
