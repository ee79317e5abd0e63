// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "firmware/hal/serial_line.hpp"

namespace pharos::app {

/// The frame on its way out, and nothing else: what waits behind it waits where it was made (the decoder holds four
/// sweeps), so that no byte is copied into a queue and what cannot be sent is counted where it is known by name.
class LineSender {
 public:
  explicit LineSender(hal::SerialLine& line) : line_(line) {}

  /// Hands over to the UART what it has room for. True when the frame is out and the next one may come.
  bool free() {
    if (!rest_.empty()) rest_ = rest_.subspan(line_.write(rest_));
    return rest_.empty();
  }
  /// Only when free(). The bytes must stay where they are until free() again; empty: nothing to send.
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
