// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "firmware/hal/serial_line.hpp"

namespace pharos::app {

/// The frame being sent, and nothing else: further output waits at its source (the decoder holds four sweeps), so that
/// no byte is copied into a queue and what cannot be sent is counted at its source by name.
class LineSender {
 public:
  explicit LineSender(hal::SerialLine& line) : line_(line) {}

  /// Passes to the UART as many bytes as fit. True when the frame is sent and the next one may follow.
  bool free() {
    if (!rest_.empty()) rest_ = rest_.subspan(line_.write(rest_));
    return rest_.empty();
  }
  /// Only when free(). The bytes must stay valid until free() again; empty: nothing to send.
  void send(std::span<const std::uint8_t> frame) {
    rest_ = frame;
    if (!frame.empty()) ++frames_;
    free();
  }
  /// The last byte has left the pin.
  bool silent() { return free() && line_.idle(); }
  std::uint32_t frames() const { return frames_; }

 private:
  hal::SerialLine& line_;
  std::span<const std::uint8_t> rest_;
  std::uint32_t frames_ = 0;
};

}  // namespace pharos::app
