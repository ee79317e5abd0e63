// SPDX-License-Identifier: Apache-2.0
// The build `decoder`: sweeps and OOTX payloads. One loop, no interrupts.
#include "firmware/app/program.hpp"
#include "firmware/hal/board.hpp"

int main() {
  static pharos::app::Program program(pharos::hal::start_board(), nullptr);
  for (;;) {
    if (!program.poll()) pharos::hal::wait_for_event();
  }
}
