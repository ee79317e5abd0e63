// SPDX-License-Identifier: Apache-2.0
// Prints the state that the platform set up, for platform_test.sh.
#include <cstdint>

#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/mmio.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/board/rv32/stack_mark.hpp"

namespace {

using namespace pharos::board;

struct Constructed {
  std::uint32_t value;
  explicit Constructed(std::uint32_t of) : value(of) {}
};
volatile std::uint32_t seed = 40;
const Constructed constructed(seed + 2);
std::uint32_t zeroes[8];

void say(std::string_view name, std::int64_t value) {
  console_write(name);
  console_write(" ");
  console_write_decimal(value);
  console_write("\n");
}

std::uint32_t use_stack() {
  volatile std::uint32_t block[256];
  for (auto& word : block) word = 1;
  return block[7];
}

}  // namespace

int main() {
  say("constructed", constructed.value);
  std::uint32_t sum = 0;
  for (const std::uint32_t word : zeroes) sum += word;
  say("zeroes", sum);

  const std::uint64_t before = instructions_retired();
  for (int i = 0; i < 1000; ++i) asm volatile("");
  say("instructions", static_cast<std::int64_t>(instructions_retired() - before));

  const std::uint32_t untouched = stack_never_used_bytes();
  use_stack();
  say("stack", stack_bytes());
  say("stack_used_more", untouched - stack_never_used_bytes());

  const std::int64_t start_ticks = machine_ticks();
  while (machine_ticks() - start_ticks < 50'000) {
  }
  say("ticks", machine_ticks() - start_ticks);
#ifdef PHAROS_PROBE_FAULT
  mmio32(0x4) = 1;  // no device at this address
#endif
  return 3;
}
