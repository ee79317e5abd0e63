// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "pharos/wire/hello_message.hpp"

namespace pharos::hal {

/// The processor and its surroundings.
class System {
 public:
  /// Processor clocks, 32 bits that wrap: the cost of work. Where they cannot be counted, instructions.
  virtual std::uint32_t cycles() = 0;
  /// Of them in a second.
  virtual std::uint32_t clock_hz() = 0;
  /// Restarts the program unless called again within the watchdog's time (about a second).
  virtual void feed_watchdog() = 0;
  /// The program works: the loader need not fall back on the previous image.
  virtual void confirm_start() = 0;
  /// Restarts, at the loader; `stay_in_loader`: the loader waits for a new image.
  [[noreturn]] virtual void restart(bool stay_in_loader) = 0;

  virtual wire::ResetCause reset_cause() = 0;
  virtual std::uint16_t start_count() = 0;
  /// Bytes of the stack that were never written since start.
  virtual std::uint32_t stack_never_used_bytes() = 0;
  virtual std::string_view board_name() = 0;
  /// 0 where the board has none.
  virtual std::uint32_t unique_id() = 0;

 protected:
  ~System() = default;
};

}  // namespace pharos::hal
