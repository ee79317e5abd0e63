// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace pharos::hal {

/// A UART. No call blocks.
class SerialLine {
 public:
  /// Number of these bytes accepted, from the first on; 0 while its buffer is full.
  virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;
  /// Everything written has left the pin.
  virtual bool idle() = 0;
  /// The oldest received byte.
  virtual std::optional<std::uint8_t> read() = 0;
  /// Bytes lost or corrupted on reception, since start.
  virtual std::uint32_t receive_errors() = 0;

 protected:
  ~SerialLine() = default;
};

}  // namespace pharos::hal
