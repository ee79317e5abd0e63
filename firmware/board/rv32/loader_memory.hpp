// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "firmware/boot/retained.hpp"

extern "C" {
// By boot/loader.ld.
extern std::uint8_t __loader[];
extern std::uint8_t __chip_start[];
extern std::uint8_t __loader_start[];
extern std::uint8_t __external_start[];
extern std::uint8_t __external_end[];
extern volatile pharos::boot::Retained __retained;
}

namespace pharos::board {

/// The memory of a board for its loader.
class LoaderMemory {
 public:
  /// On-chip memory except the loader's own, or external memory.
  static std::uint8_t* memory(std::uint32_t address, std::uint32_t bytes) {
    return is_within(address, bytes, __chip_start, __loader_start) ||
                   is_within(address, bytes, __external_start, __external_end)
               ? reinterpret_cast<std::uint8_t*>(address)
               : nullptr;
  }
  static volatile boot::Retained& retained() { return __retained; }
  [[noreturn]] static void start(std::uint32_t entry) {
    // The data just written is executed next.
    asm volatile(".option push\n.option arch, +zifencei\nfence.i\n.option pop" ::: "memory");
    reinterpret_cast<void (*)()>(entry)();
    __builtin_unreachable();
  }

 private:
  static bool is_within(std::uint32_t address, std::uint32_t bytes, const std::uint8_t* start,
                        const std::uint8_t* end) {
    const auto room = static_cast<std::uint32_t>(end - start);
    const std::uint32_t before = address - reinterpret_cast<std::uintptr_t>(start);  // huge where it lies below
    return before <= room && bytes <= room - before;
  }
};

}  // namespace pharos::board
