// SPDX-License-Identifier: Apache-2.0
// The functions below the C library that a test program (never the core) needs: a heap, and standard output on the
// first UART.
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "firmware/board/qemu_virt/machine.hpp"

namespace {

using pharos::board::console_put;
using pharos::board::console_write;

// The machine's memory above the regions of memory_external.ld: the largest test stores minutes of light.
constexpr std::uintptr_t kHeap = 0x81000000;
constexpr std::size_t kHeapBytes = 16 << 20;
std::size_t heap_used = 0;

int put(char byte, FILE*) {
  console_put(byte);
  return static_cast<unsigned char>(byte);
}
FILE console = FDEV_SETUP_STREAM(put, nullptr, nullptr, _FDEV_SETUP_WRITE);

}  // namespace

FILE* const stdout = &console;

extern "C" {

void* sbrk(std::ptrdiff_t increment) {
  const std::size_t wanted = heap_used + static_cast<std::size_t>(increment);
  if (wanted > kHeapBytes) {
    console_write("the tests' heap is used up\n");
    pharos::board::exit_emulator(1);
  }
  const std::uintptr_t block = kHeap + heap_used;
  heap_used = wanted;
  return reinterpret_cast<void*>(block);
}
}
