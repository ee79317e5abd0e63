// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/boot/boot_board.hpp"
#include "firmware/boot/loader.hpp"

namespace pharos::boot {

/// All that happens after a reset, with a loader as it was made. Ends in the board's start() or restart().
template <BootBoard Board>
void boot(Loader<Board>& loader) {
  Board::prepare();
  note_reset(Board::retained());
  const bool asked = take_loader_request(Board::retained());
  loader.find_image();
  if (loader.loaded() != nullptr && !asked && !loader.is_called()) {
    Board::start(loader.loaded()->entry_address);
    return;
  }
  loader.serve();
  announce_reset(Board::retained(), wire::ResetCause::kCommand);
  Board::restart();
}

}  // namespace pharos::boot
