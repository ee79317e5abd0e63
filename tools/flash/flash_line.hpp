// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace pharos::tools {

/// Flashing failed. The message is one line for the user: what, and what to do.
class FlashError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The serial line to a target, with its clock. Both throw FlashError when the line is gone.
class FlashLine {
 public:
  FlashLine() = default;
  FlashLine(const FlashLine&) = delete;
  FlashLine& operator=(const FlashLine&) = delete;
  virtual ~FlashLine() = default;

  virtual void write(std::span<const std::uint8_t> bytes) = 0;
  /// Waits for bytes until `deadline_ns`; returns their number, 0 on timeout.
  virtual std::size_t read(std::span<std::uint8_t> out, std::int64_t deadline_ns) = 0;
  /// Monotonic.
  virtual std::int64_t now_ns() = 0;
};

}  // namespace pharos::tools
