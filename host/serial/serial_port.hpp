// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "host/support/unique_fd.hpp"
#include "pharos/base/result.hpp"

namespace pharos::host {

/// Why a port could not be opened.
enum class OpenError : std::uint8_t {
  kNone,
  kMissing,       // no such device, or it was unplugged
  kNoPermission,  // the user is not in the port's group
  kBusy,          // another program uses it
  kNotATerminal,  // a file, folder or device of another kind
  kBadSpeed,      // the adapter does not support this speed
  kOther,
};

/// The same with one line for the user: what, where, what to do.
struct OpenFailure {
  OpenError error = OpenError::kNone;
  std::string message;
};

/// Result of a read or write.
struct Transfer {
  std::size_t bytes = 0;
  bool gone = false;  // unplugged or hung up: close the port
};

/// A serial port: raw 8N1, non-blocking, exclusive (a second program that opens it gets an error).
class SerialPort {
 public:
  static Result<SerialPort, OpenFailure> open(const std::string& path, int baud);

  SerialPort() = default;
  SerialPort(SerialPort&&) noexcept = default;
  SerialPort& operator=(SerialPort&& other) noexcept;
  ~SerialPort() { close(); }
  bool is_open() const { return fd_.valid(); }
  /// For the poll loop: readable when bytes are available and when the device is gone.
  int fd() const { return fd_.get(); }
  /// The available bytes; 0 bytes and not gone when there are none.
  Transfer read(std::span<std::uint8_t> out);
  /// Writes as many bytes as the port accepts now.
  Transfer write(std::span<const std::uint8_t> bytes);

 private:
  explicit SerialPort(UniqueFd fd) : fd_(std::move(fd)) {}
  void close();

  UniqueFd fd_;
};

}  // namespace pharos::host
