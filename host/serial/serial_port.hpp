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
  kBusy,          // another program has it
  kNotATerminal,  // a file, folder or device of another kind
  kBadSpeed,      // the adapter does not do this speed
  kOther,
};

/// The same with a line for a person: what, where, what to do.
struct OpenFailure {
  OpenError error = OpenError::kNone;
  std::string message;
};

/// What a read or write came to.
struct Transfer {
  std::size_t bytes = 0;
  bool gone = false;  // unplugged or hung up: close the port
};

/// A serial line of our own: raw 8N1, non-blocking, exclusive (a second program that opens it gets an error).
class SerialPort {
 public:
  static Result<SerialPort, OpenFailure> open(const std::string& path, int baud);

  SerialPort() = default;
  SerialPort(SerialPort&&) noexcept = default;
  SerialPort& operator=(SerialPort&& other) noexcept;
  ~SerialPort() { close(); }
  bool is_open() const { return fd_.valid(); }
  /// For the poll loop: readable when bytes are there and when the line is gone.
  int fd() const { return fd_.get(); }
  /// What is there now; 0 bytes and not gone when nothing is.
  Transfer read(std::span<std::uint8_t> out);
  /// As much as the line takes now.
  Transfer write(std::span<const std::uint8_t> bytes);

 private:
  explicit SerialPort(UniqueFd fd) : fd_(std::move(fd)) {}
  void close();

  UniqueFd fd_;
};

}  // namespace pharos::host
