// SPDX-License-Identifier: Apache-2.0
// One loader a board: -DPHAROS_LOADER_BOARD names the header with its LoaderBoard.
#include PHAROS_LOADER_BOARD
#include "firmware/boot/boot.hpp"

namespace {

using pharos::board::LoaderBoard;
static_assert(pharos::boot::BootBoard<LoaderBoard>);

constinit pharos::boot::Loader<LoaderBoard> loader;

}  // namespace

extern "C" [[noreturn]] void pharos_loader() { pharos::boot::boot(loader); }
