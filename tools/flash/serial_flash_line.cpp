// SPDX-License-Identifier: Apache-2.0
#include "tools/flash/serial_flash_line.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::int64_t kWriteTimeout_ns = 5000 * kNsPerMs;

host::SerialPort opened(const std::string& path, int baud) {
  auto port = host::SerialPort::open(path, baud);
  if (!port) throw host::InputError(port.error().message);
  return std::move(*port);
}

}  // namespace

SerialFlashLine::SerialFlashLine(const std::string& path, int baud) : path_(path), port_(opened(path, baud)) {}

std::int64_t SerialFlashLine::now_ns() {
  using std::chrono::steady_clock;
  return std::chrono::duration_cast<std::chrono::nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

bool SerialFlashLine::wait(short events, std::int64_t deadline_ns) {
  const std::int64_t left = std::max<std::int64_t>(0, deadline_ns - now_ns());
  pollfd poll_fd{port_.fd(), events, 0};
  return ::poll(&poll_fd, 1, static_cast<int>((left + kNsPerMs - 1) / kNsPerMs)) > 0;
}

std::size_t SerialFlashLine::checked(host::Transfer transfer) const {
  if (transfer.gone)
    throw FlashError(path_ + ": was unplugged; what ran before is still there: plug it in and run this again");
  return transfer.bytes;
}

void SerialFlashLine::write(std::span<const std::uint8_t> bytes) {
  const std::int64_t deadline = now_ns() + kWriteTimeout_ns;
  while (!bytes.empty()) {
    if (!wait(POLLOUT, deadline)) throw FlashError(path_ + ": takes no bytes; check the cable");
    bytes = bytes.subspan(checked(port_.write(bytes)));
  }
}

std::size_t SerialFlashLine::read(std::span<std::uint8_t> out, std::int64_t deadline_ns) {
  return wait(POLLIN, deadline_ns) ? checked(port_.read(out)) : 0;
}

}  // namespace pharos::tools
