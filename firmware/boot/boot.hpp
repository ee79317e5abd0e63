// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/boot/boot_board.hpp"
#include "firmware/boot/loader.hpp"

namespace pharos::boot {

/// Everything after a reset, with a loader as constructed.
template <BootBoard Board>
[[noreturn]] void boot(Loader<Board>& loader) {
  Board::prepare();
  note_reset(Board::retained());
  loader.prepare(take_loader_request(Board::retained()));
  for (;;) {
    const Turn turn = loader.turn();
    if (turn == Turn::kStart) {
      note_start(Board::retained());
      Board::start(loader.loaded()->entry_address);
    }
    if (turn == Turn::kRestart) {
      reset_boot_attempts(Board::retained());
      announce_reset(Board::retained(), wire::ResetCause::kCommand);
      Board::restart();
    }
  }
}

}  // namespace pharos::boot
