// SPDX-License-Identifier: Apache-2.0
#include "host/serial/reopening_port.hpp"

#include <utility>

namespace pharos::host {

ReopeningPort::Attempt ReopeningPort::try_open(std::int64_t now_ns) {
  if (port_.is_open() || (waiting_ && now_ns < next_attempt_ns_)) return Attempt::kNone;
  auto opened = SerialPort::open(path_, baud_);
  if (opened) {
    port_ = std::move(*opened);
    failure_ = {};
    waiting_ = false;
    ++times_opened_;
    return Attempt::kOpened;
  }
  waiting_ = true;
  next_attempt_ns_ = now_ns + kReopenPeriod_ns;
  OpenFailure now = opened.error();
  const bool reported = now.message == failure_.message;
  failure_ = std::move(now);
  return reported ? Attempt::kStillGone : Attempt::kFailed;
}

Transfer ReopeningPort::checked(Transfer transfer, std::int64_t now_ns) {
  if (!transfer.gone) return transfer;
  port_ = SerialPort();
  waiting_ = true;
  next_attempt_ns_ = now_ns + kReopenPeriod_ns;
  ++times_lost_;
  return transfer;
}

Transfer ReopeningPort::read(std::span<std::uint8_t> out, std::int64_t now_ns) {
  if (!port_.is_open()) return {};
  return checked(port_.read(out), now_ns);
}

Transfer ReopeningPort::write(std::span<const std::uint8_t> bytes, std::int64_t now_ns) {
  if (!port_.is_open()) return {};
  return checked(port_.write(bytes), now_ns);
}

}  // namespace pharos::host
