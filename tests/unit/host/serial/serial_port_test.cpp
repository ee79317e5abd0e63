// SPDX-License-Identifier: Apache-2.0
#include "host/serial/serial_port.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <termios.h>

#include <fstream>
#include <numeric>
#include <vector>

#include "host/serial/line_settings.hpp"
#include "unit/host/serial/pty.hpp"

namespace pharos::host {
namespace {

using test::Pty;
using test::wait_readable;
using Bytes = std::vector<std::uint8_t>;

Bytes read_exactly(SerialPort& port, std::size_t count) {
  Bytes got;
  std::array<std::uint8_t, 64> chunk{};
  while (got.size() < count && wait_readable(port.fd())) {
    const Transfer transfer = port.read(chunk);
    if (transfer.gone) break;
    got.insert(got.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(transfer.bytes));
  }
  return got;
}

TEST(SerialPort, PassesEveryByteUnchangedBothWays) {
  Pty pty;
  auto port = SerialPort::open(pty.path, 115'200);
  ASSERT_TRUE(port.ok()) << port.error().message;
  Bytes all(256);
  std::iota(all.begin(), all.end(), std::uint8_t{0});
  pty.send(all);
  EXPECT_EQ(read_exactly(*port, all.size()), all);

  ASSERT_EQ(port->write(all).bytes, all.size());
  Bytes back(all.size());
  std::size_t have = 0;
  while (have < back.size() && wait_readable(pty.target.get())) {
    have += static_cast<std::size_t>(::read(pty.target.get(), back.data() + have, back.size() - have));
  }
  EXPECT_EQ(back, all);
}

TEST(SerialPort, ReadsNothingWhenNothingIsThere) {
  Pty pty;
  auto port = SerialPort::open(pty.path, 115'200);
  ASSERT_TRUE(port.ok());
  std::array<std::uint8_t, 8> out{};
  const Transfer transfer = port->read(out);
  EXPECT_EQ(transfer.bytes, 0u);
  EXPECT_FALSE(transfer.gone);
}

TEST(SerialPort, SetsAnySpeedTheKernelGives) {
  // Numeric speeds, read back: there is no table of constants that could be wrong.
  for (const int baud : {9'600, 115'200, 230'400, 250'000, 460'800, 921'600, 1'000'000, 3'000'000, 12'345}) {
    Pty pty;
    auto port = SerialPort::open(pty.path, baud);
    ASSERT_TRUE(port.ok()) << port.error().message;
    EXPECT_EQ(line_speed(port->fd()), baud);
  }
}

TEST(SerialPort, IsRawEightBitsNoParityOneStop) {
  Pty pty;
  auto port = SerialPort::open(pty.path, 460'800);
  ASSERT_TRUE(port.ok());
  termios line{};
  ASSERT_EQ(::tcgetattr(port->fd(), &line), 0);
  EXPECT_EQ(line.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
  EXPECT_EQ(line.c_cflag & (PARENB | CSTOPB | CRTSCTS), 0u);
  EXPECT_NE(line.c_cflag & CLOCAL, 0u);
  EXPECT_EQ(line.c_iflag, 0u);
  EXPECT_EQ(line.c_oflag & OPOST, 0u);
  EXPECT_EQ(line.c_lflag & (ICANON | ECHO | ISIG | IEXTEN), 0u);
}

TEST(SerialPort, ASecondOpenerLearnsThatItIsInUse) {
  Pty pty;
  auto first = SerialPort::open(pty.path, 115'200);
  ASSERT_TRUE(first.ok());
  {
    const auto second = SerialPort::open(pty.path, 115'200);
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().error, OpenError::kBusy);
    EXPECT_NE(second.error().message.find("in use by another program"), std::string::npos);
  }
  SerialPort moved = std::move(*first);  // moving keeps the ownership
  EXPECT_FALSE(SerialPort::open(pty.path, 115'200).ok());
  moved = SerialPort();  // closing releases it
  EXPECT_TRUE(SerialPort::open(pty.path, 115'200).ok());
}

TEST(SerialPort, SaysWhatToDoWhenItCannotOpen) {
  const auto missing = SerialPort::open("/dev/no-such-port", 115'200);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().error, OpenError::kMissing);
  EXPECT_EQ(missing.error().message.rfind("/dev/no-such-port: ", 0), 0u);

  EXPECT_EQ(SerialPort::open("/", 115'200).error().error, OpenError::kNotATerminal);
  EXPECT_EQ(SerialPort::open("/dev/null", 115'200).error().error, OpenError::kNotATerminal);
  const std::string file = ::testing::TempDir() + "pharos_not_a_port";
  std::ofstream(file) << "text";
  EXPECT_EQ(SerialPort::open(file, 115'200).error().error, OpenError::kNotATerminal);

  Pty pty;
  EXPECT_EQ(SerialPort::open(pty.path, 0).error().error, OpenError::kBadSpeed);
  EXPECT_EQ(SerialPort::open(pty.path, -5).error().error, OpenError::kBadSpeed);
  EXPECT_TRUE(SerialPort::open(pty.path, 9600).ok()) << "a failed open must not keep the line";
}

TEST(SerialPort, NamesTheGroupWhenPermissionIsMissing) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may open every port";
  Pty pty;
  ASSERT_EQ(::chmod(pty.path.c_str(), 0), 0);
  const auto port = SerialPort::open(pty.path, 115'200);
  ASSERT_FALSE(port.ok());
  EXPECT_EQ(port.error().error, OpenError::kNoPermission);
  EXPECT_NE(port.error().message.find("dialout"), std::string::npos);
}

TEST(SerialPort, ReportsADisconnectedLine) {
  Pty pty;
  auto port = SerialPort::open(pty.path, 115'200);
  ASSERT_TRUE(port.ok());
  pty.unplug();
  ASSERT_TRUE(wait_readable(port->fd()));
  std::array<std::uint8_t, 8> out{};
  EXPECT_TRUE(port->read(out).gone);
}

}  // namespace
}  // namespace pharos::host
