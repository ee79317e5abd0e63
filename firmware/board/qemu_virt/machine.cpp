// SPDX-License-Identifier: Apache-2.0
#include "firmware/board/qemu_virt/machine.hpp"

#include <array>

#include "firmware/board/rv32/mmio.hpp"
#include "firmware/board/rv32/processor.hpp"

namespace pharos::board {
namespace {

constexpr std::uintptr_t kTest = 0x100000;
constexpr std::uint32_t kTestPass = 0x5555;
constexpr std::uint32_t kTestFail = 0x3333;  // exit code in the upper half
constexpr std::uint32_t kTestReset = 0x7777;

constexpr std::uintptr_t kTimerCompare = 0x2004000;
constexpr std::uintptr_t kTimer = 0x200BFF8;
constexpr std::int64_t kTicksPerTimerStep = 5;  // 50 MHz / 10 MHz

constexpr std::uintptr_t kUart = 0x10000000;
constexpr std::uintptr_t kUartLineStatus = kUart + 5;
constexpr std::uint8_t kUartTransmitEmpty = 0x20;

}  // namespace

void exit_emulator(int code) {
  mmio32(kTest) = code == 0 ? kTestPass : kTestFail | (static_cast<std::uint32_t>(code) << 16);
  for (;;) wait_for_interrupt();
}

void reset_machine() {
  mmio32(kTest) = kTestReset;
  for (;;) wait_for_interrupt();
}

std::int64_t machine_ticks() {
  std::uint32_t high = 0;
  std::uint32_t low = 0;
  do {
    high = mmio32(kTimer + 4);
    low = mmio32(kTimer);
  } while (high != mmio32(kTimer + 4));
  return static_cast<std::int64_t>((std::uint64_t{high} << 32) | low) * kTicksPerTimerStep;
}

void set_timer(std::int64_t machine_ticks) {
  const auto compare = static_cast<std::uint64_t>(machine_ticks / kTicksPerTimerStep);
  mmio32(kTimerCompare + 4) = UINT32_MAX;  // no interrupt between the two halves
  mmio32(kTimerCompare) = static_cast<std::uint32_t>(compare);
  mmio32(kTimerCompare + 4) = static_cast<std::uint32_t>(compare >> 32);
}

void console_put(char byte) {
  while ((mmio8(kUartLineStatus) & kUartTransmitEmpty) == 0) {
  }
  mmio8(kUart) = static_cast<std::uint8_t>(byte);
}

void console_write(std::string_view text) {
  for (const char byte : text) console_put(byte);
}

void console_write_decimal(std::int64_t number) {
  std::array<char, 20> digits{};
  std::size_t count = 0;
  auto rest = number < 0 ? 0 - static_cast<std::uint64_t>(number) : static_cast<std::uint64_t>(number);
  do {
    digits[count++] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest != 0);
  if (number < 0) console_put('-');
  while (count != 0) console_put(digits[--count]);
}

void console_write_hex(std::uint32_t number) {
  for (int shift = 28; shift >= 0; shift -= 4) console_put("0123456789abcdef"[(number >> shift) & 15U]);
}

}  // namespace pharos::board
