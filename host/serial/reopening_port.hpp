// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/serial/serial_port.hpp"

namespace pharos::host {

/// Time between two attempts to open a port that is gone: short for the user, and negligible for the processor.
inline constexpr std::int64_t kReopenPeriod_ns = 500'000'000;

/// A port that is opened again after it was unplugged. No thread and no timer of its own: the poll loop's timer calls
/// try_open() at least twice a second; the caller passes the time (monotonic ns).
class ReopeningPort {
 public:
  enum class Attempt : std::uint8_t {
    kNone,       // open already, or too early for the next attempt
    kOpened,     // now open: watch fd()
    kFailed,     // not opened, for a new reason: report it once
    kStillGone,  // not opened, for the same reason as last time
  };

  ReopeningPort(std::string path, int baud) : path_(std::move(path)), baud_(baud) {}

  Attempt try_open(std::int64_t now_ns);
  /// Reads the available bytes. `gone`: the port was just lost and is closed (remove its fd from the poll loop *before*
  /// the next call).
  Transfer read(std::span<std::uint8_t> out, std::int64_t now_ns);
  Transfer write(std::span<const std::uint8_t> bytes, std::int64_t now_ns);

  bool is_open() const { return port_.is_open(); }
  int fd() const { return port_.fd(); }
  const std::string& path() const { return path_; }
  /// Why the last attempt failed; empty while open or before the first attempt.
  const OpenFailure& failure() const { return failure_; }
  std::uint64_t times_opened() const { return times_opened_; }
  std::uint64_t times_lost() const { return times_lost_; }

 private:
  Transfer checked(Transfer transfer, std::int64_t now_ns);

  std::string path_;
  int baud_ = 0;
  SerialPort port_;
  OpenFailure failure_;
  bool waiting_ = false;  // next_attempt_ns_ counts
  std::int64_t next_attempt_ns_ = 0;
  std::uint64_t times_opened_ = 0;
  std::uint64_t times_lost_ = 0;
};

}  // namespace pharos::host
