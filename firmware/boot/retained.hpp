// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/wire/hello_message.hpp"

namespace pharos::boot {

/// What outlives a reset: the last 32 bytes of the on-chip memory, which neither start-up code nor image touches
/// (`__retained` in the linker scripts). Power loss leaves anything in it; `mark` tells that from a kept one.
///
/// Before a reset: announce_reset(). After it the loader calls note_reset(), once; the application only reads.
struct Retained {
  static constexpr std::uint32_t kMark = 0x50485254;  // holds after the first note_reset() since power on

  std::uint32_t mark = 0;
  std::uint32_t announced = 0;  // wire::ResetCause of the reset that is about to come; 0: nobody said
  std::uint32_t stay_in_loader = 0;
  std::uint32_t last_cause = 0;  // wire::ResetCause of the last reset, for Hello
  std::uint32_t start_count = 0;
  // Of the last fault since power on, in the words of the privileged specification; the application's to fill.
  std::uint32_t fault_cause = 0;    // mcause
  std::uint32_t fault_address = 0;  // mepc
  std::uint32_t fault_value = 0;    // mtval
};
static_assert(sizeof(Retained) == 32);

/// Last words before a reset that the program itself asks for: command or fault. `stay_in_loader`: CommandCode
/// kEnterLoader. Call it, then reset.
inline void announce_reset(volatile Retained& retained, wire::ResetCause cause, bool stay_in_loader = false) {
  retained.announced = static_cast<std::uint32_t>(cause);
  retained.stay_in_loader = stay_in_loader ? 1 : 0;
}

/// First thing after a reset. A reset that nobody announced is the watchdog's, or power on when nothing was kept.
inline void note_reset(volatile Retained& retained) {
  if (retained.mark != Retained::kMark) {
    retained.announced = static_cast<std::uint32_t>(wire::ResetCause::kPowerOn);
    retained.stay_in_loader = 0;
    retained.start_count = 0;
    retained.fault_cause = 0;
    retained.fault_address = 0;
    retained.fault_value = 0;
    retained.mark = Retained::kMark;
  }
  const std::uint32_t announced = retained.announced;
  const bool known = announced - 1 < wire::kResetCauses - 1u;
  retained.last_cause = known ? announced : static_cast<std::uint32_t>(wire::ResetCause::kWatchdog);
  retained.announced = 0;
  retained.start_count = retained.start_count + 1;
}

/// Whether the program that ran before the reset asked for the loader. Asks once: the next start is an ordinary one.
inline bool take_loader_request(volatile Retained& retained) {
  const bool asked = retained.stay_in_loader == 1;
  retained.stay_in_loader = 0;
  return asked;
}

/// Why the target started last; unknown where no loader ran before.
inline wire::ResetCause last_reset(const volatile Retained& retained) {
  const bool known = retained.mark == Retained::kMark && retained.last_cause < wire::kResetCauses;
  return known ? static_cast<wire::ResetCause>(retained.last_cause) : wire::ResetCause::kUnknown;
}

}  // namespace pharos::boot
