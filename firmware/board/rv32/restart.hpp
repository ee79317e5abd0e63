// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/boot/retained.hpp"

extern "C" volatile pharos::boot::Retained __retained;  // by the linker script

namespace pharos::board {

inline volatile boot::Retained& retained() { return __retained; }

/// Resets processor and devices; memory is kept. Each board defines it.
[[noreturn]] void reset_machine();

}  // namespace pharos::board
