// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/wire/hello_message.hpp"

namespace pharos::boot {

/// Memory kept over a reset: the last 32 bytes of the on-chip memory, which neither start-up code nor image touches
/// (`__retained` in the linker scripts). After a loss of power it holds anything; `mark` distinguishes that from kept
/// data.
///
/// Before a reset: announce_reset(). After it the loader calls note_reset(), once; the application only reads.
struct Retained {
  static constexpr std::uint32_t kMark = 0x50485254;  // valid after the first note_reset() since power on

  /// Starts in which an image has to confirm itself; then the one before it is started until the next power on or until
  /// the loader is requested.
  static constexpr std::uint16_t kMaxBootAttempts = 3;

  std::uint32_t mark = 0;
  std::uint32_t announced = 0;  // wire::ResetCause of the reset that follows; 0: not announced
  std::uint16_t stay_in_loader = 0;
  std::uint16_t confirmed = 0;   // the newest image called confirm_start()
  std::uint32_t last_cause = 0;  // wire::ResetCause of the last reset, for Hello
  std::uint16_t start_count = 0;
  std::uint16_t unconfirmed_starts = 0;  // in a row without confirm_start()
  // Of the last fault since power on, in the words of the privileged specification; the application's to fill.
  std::uint32_t fault_cause = 0;    // mcause
  std::uint32_t fault_address = 0;  // mepc
  std::uint32_t fault_value = 0;    // mtval
};
static_assert(sizeof(Retained) == 32);

/// Called before a reset by the program itself: command or fault. `stay_in_loader`: CommandCode kEnterLoader. Then
/// reset.
inline void announce_reset(volatile Retained& retained, wire::ResetCause cause, bool stay_in_loader = false) {
  retained.announced = static_cast<std::uint32_t>(cause);
  retained.stay_in_loader = stay_in_loader ? 1 : 0;
}

/// Called first after a reset. An unannounced reset is the watchdog's, or power on when nothing was kept.
inline void note_reset(volatile Retained& retained) {
  if (retained.mark != Retained::kMark) {
    retained.announced = static_cast<std::uint32_t>(wire::ResetCause::kPowerOn);
    retained.stay_in_loader = 0;
    retained.confirmed = 0;
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

/// Whether the newest image had all its starts: then the other one is to be started.
inline bool boot_attempts_exhausted(const volatile Retained& retained) {
  return retained.unconfirmed_starts >= Retained::kMaxBootAttempts;
}

/// Called by the loader directly before it starts an image.
inline void note_start(volatile Retained& retained) {
  retained.unconfirmed_starts = static_cast<std::uint16_t>(retained.unconfirmed_starts + 1);
}

/// Called by the loader before a reset that is to start the newest image: it may differ from the one that failed.
inline void reset_boot_attempts(volatile Retained& retained) { retained.unconfirmed_starts = 0; }

/// Called by the application once it works. Confirming the fallback image does not bring back the other one.
inline void confirm_start(volatile Retained& retained) {
  if (boot_attempts_exhausted(retained)) return;
  reset_boot_attempts(retained);
  retained.confirmed = 1;
}

/// Whether the previous program requested the loader. Cleared by the call: the next start is an ordinary one.
inline bool take_loader_request(volatile Retained& retained) {
  const bool asked = retained.stay_in_loader == 1;
  retained.stay_in_loader = 0;
  return asked;
}

/// Whether the newest image was confirmed since the loader last asked. Cleared by the call.
inline bool take_confirmation(volatile Retained& retained) {
  const bool confirmed = retained.confirmed == 1;
  retained.confirmed = 0;
  return confirmed;
}

/// Reason of the target's last start; unknown where no loader ran before.
inline wire::ResetCause last_reset(const volatile Retained& retained) {
  const bool known = retained.mark == Retained::kMark && retained.last_cause < wire::kResetCauses;
  return known ? static_cast<wire::ResetCause>(retained.last_cause) : wire::ResetCause::kUnknown;
}

}  // namespace pharos::boot
