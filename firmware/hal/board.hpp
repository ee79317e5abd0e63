// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/hal/edge_capture.hpp"
#include "firmware/hal/serial_line.hpp"
#include "firmware/hal/system.hpp"

namespace pharos::hal {

/// The hardware that the program runs on.
struct Board {
  EdgeCapture& capture;
  SerialLine& line;
  System& system;
};

/// Sets the hardware up; once, first thing in main. Each board defines it.
Board start_board();
/// Nothing to do at the moment: a board may sleep here until something could have come, a millisecond at most.
void wait_for_event();
/// Calls handler(context) once a millisecond from the timer's interrupt, from now on.
void call_every_millisecond(void (*handler)(void* context), void* context);

/// While such an object exists, call_every_millisecond's handler does not run.
class NoInterrupts {
 public:
  NoInterrupts();
  ~NoInterrupts();
  NoInterrupts(const NoInterrupts&) = delete;
  NoInterrupts& operator=(const NoInterrupts&) = delete;
};

}  // namespace pharos::hal
