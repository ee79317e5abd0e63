// SPDX-License-Identifier: Apache-2.0
#include "firmware/board/rv32/stack_mark.hpp"

extern "C" {
extern const volatile std::uint32_t __stack_bottom[];  // by the linker script
extern const volatile std::uint32_t __stack_top[];
}

namespace pharos::board {
namespace {

constexpr std::uint32_t kUntouched = 0x5AA5F00D;  // as in start.S

}  // namespace

std::uint32_t stack_bytes() { return static_cast<std::uint32_t>(__stack_top - __stack_bottom) * 4; }

std::uint32_t stack_never_used_bytes() {
  const volatile std::uint32_t* word = __stack_bottom;
  while (word != __stack_top && *word == kUntouched) ++word;
  return static_cast<std::uint32_t>(word - __stack_bottom) * 4;
}

}  // namespace pharos::board
