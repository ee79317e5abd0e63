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

  /// Starts that an image has to confirm itself in; then the other slot's is started until power goes or the loader was
  /// asked to start.
  static constexpr std::uint16_t kMaxBootAttempts = 3;

  std::uint32_t mark = 0;
  std::uint32_t announced = 0;  // wire::ResetCause of the reset that is about to come; 0: nobody said
  std::uint32_t stay_in_loader = 0;
  std::uint32_t last_cause = 0;  // wire::ResetCause of the last reset, for Hello
  std::uint16_t start_count = 0;
  std::uint16_t unconfirmed_starts = 0;  // in a row without confirm_start()
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
    retained.unconfirmed_starts = 0;
    retained.fault_cause = 0;
    retained.fault_address = 0;
    retained.fault_value = 0;
    retained.mark = Retained::kMark;
  }
  const std::uint32_t announced = retained.announced;
  const bool known = announced - 1 < wire::kResetCauses - 1u;
  retained.last_cause = known ? announced : static_cast<std::uint32_t>(wire::ResetCause::kWatchdog);
  retained.announced = 0;
  retained.start_count = static_cast<std::uint16_t>(retained.start_count + 1);
}

/// Whether the newest image had its tries: then the other one is to be started.
inline bool boot_attempts_exhausted(const volatile Retained& retained) {
  return retained.unconfirmed_starts >= Retained::kMaxBootAttempts;
}

/// The loader's, right before it starts an image.
inline void note_start(volatile Retained& retained) {
  retained.unconfirmed_starts = static_cast<std::uint16_t>(retained.unconfirmed_starts + 1);
}

/// The loader's, before a reset that is to start the newest image: it may be another than the one that had its tries.
inline void reset_boot_attempts(volatile Retained& retained) { retained.unconfirmed_starts = 0; }

/// The application's, once it does its work. An image that was fallen back on does not bring back the other one.
inline void confirm_start(volatile Retained& retained) {
  if (!boot_attempts_exhausted(retained)) reset_boot_attempts(retained);
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
