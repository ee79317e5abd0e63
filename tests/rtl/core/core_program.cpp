// SPDX-License-Identifier: Apache-2.0
// Runs a program that was linked for QEMU's machine on the Verilated core: 32 MiB of RAM without waits, UART, timer,
// and the device that ends it. Exit code: the program's.
#include <elf.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "rtl/core/core_device.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kRam = 0x80000000;
constexpr std::uint32_t kRamBytes = 64 << 20;
constexpr std::uint32_t kUart = 0x10000000;
constexpr std::uint32_t kEnd = 0x00100000;
constexpr std::uint32_t kTimerCompare = 0x02004000;
constexpr std::uint32_t kTimer = 0x0200BFF8;
constexpr std::uint32_t kTransmitterIdle = 0x60;
constexpr std::uint64_t kCyclesPerTimerStep = 5;  // 50 MHz, and 10 MHz of the timer
constexpr std::uint32_t kPass = 0x5555;
constexpr std::uint32_t kFail = 0x3333;

bool refuses(std::uint32_t address) {
  return !(address - kRam < kRamBytes || (address & ~7U) == kUart || address == kEnd ||
           (address & ~7U) == kTimerCompare || (address & ~7U) == kTimer);
}

class Machine {
 public:
  bool load(const std::vector<char>& elf) {
    Elf32_Ehdr head;
    if (elf.size() < sizeof head) return false;
    std::memcpy(&head, elf.data(), sizeof head);
    if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_machine != EM_RISCV) return false;
    for (unsigned i = 0; i < head.e_phnum; ++i) {
      Elf32_Phdr part;
      if (head.e_phoff + (i + 1) * sizeof part > elf.size()) return false;
      std::memcpy(&part, &elf[head.e_phoff + i * sizeof part], sizeof part);
      if (part.p_type != PT_LOAD || part.p_filesz == 0) continue;
      if (!put(part.p_paddr, elf, part.p_offset, part.p_filesz)) return false;
    }
    // lui t0, upper; jalr x0, lower(t0)
    const std::uint32_t upper = (head.e_entry + 0x800) & 0xFFFFF000, lower = (head.e_entry - upper) & 0xFFF;
    word(kRam) = upper | 0x2B7;
    word(kRam + 4) = lower << 20 | 0x28067;
    return true;
  }
  bool put(std::uint32_t address, const std::vector<char>& bytes, std::size_t offset, std::size_t count) {
    if (address < kRam || address - kRam > kRamBytes - count || offset + count > bytes.size()) return false;
    std::memcpy(reinterpret_cast<char*>(ram_.data()) + (address - kRam), &bytes[offset], count);
    return true;
  }

  /// Exit code; -1 after so many ticks.
  int run(std::uint64_t ticks) {
    CoreInputs inputs;
    inputs.reset = true;
    for (int i = 0; i < 2; ++i) step(inputs);
    inputs.reset = false;
    while (ended_ < 0 && cycles_ < ticks) {
      step(inputs);
      ++cycles_;
      inputs.timer_interrupt = cycles_ / kCyclesPerTimerStep >= compare_;
    }
    return ended_;
  }
  std::uint64_t cycles() const { return cycles_; }
  std::uint64_t instructions() const { return instructions_; }

 private:
  void step(CoreInputs& inputs) {
    const CoreOutputs now = core_->show(inputs, &refuses);
    if (now.fetches) {
      inputs.fetch_fault = now.fetch_address - kRam >= kRamBytes;
      inputs.fetched = inputs.fetch_fault ? 0 : word(now.fetch_address);
    }
    if (now.reads && !refuses(now.data_address)) inputs.loaded = load(now.data_address);
    if (now.writes && !refuses(now.data_address)) store(now);
    if (now.ends && !inputs.reset) ++instructions_;
    core_->tick();
  }
  std::uint32_t& word(std::uint32_t address) { return ram_[(address - kRam) / 4]; }
  std::uint32_t load(std::uint32_t address) {
    if (address >= kRam) return word(address);
    const std::uint64_t now = cycles_ / kCyclesPerTimerStep;
    if (address == kUart + 4) return kTransmitterIdle << 8;  // line status, the second byte
    if ((address & ~7U) == kTimer) return static_cast<std::uint32_t>(now >> 8 * (address & 4));
    if ((address & ~7U) == kTimerCompare) return static_cast<std::uint32_t>(compare_ >> 8 * (address & 4));
    return 0;
  }
  void store(const CoreOutputs& now) {
    if (now.data_address >= kRam) {
      std::uint32_t lanes = 0;
      for (unsigned i = 0; i < 4; ++i) lanes |= (now.bytes >> i & 1U) != 0 ? 0xFFU << 8 * i : 0;
      std::uint32_t& stored = word(now.data_address);
      stored = (stored & ~lanes) | (now.stored & lanes);
    } else if (now.data_address == kUart && (now.bytes & 1) != 0) {
      std::putchar(static_cast<int>(now.stored & 0xFF));
    } else if (now.data_address == kEnd) {
      if ((now.stored & 0xFFFF) == kPass) ended_ = 0;
      if ((now.stored & 0xFFFF) == kFail) ended_ = static_cast<int>(now.stored >> 16);
    } else if ((now.data_address & ~7U) == kTimerCompare) {
      const unsigned shift = 8 * (now.data_address & 4);
      compare_ = (compare_ & ~(std::uint64_t{0xFFFFFFFF} << shift)) | std::uint64_t{now.stored} << shift;
    }
  }

  std::unique_ptr<CoreDevice> core_ = make_core_device();
  std::vector<std::uint32_t> ram_ = std::vector<std::uint32_t>(kRamBytes / 4);
  std::uint64_t compare_ = UINT64_MAX;
  std::uint64_t cycles_ = 0;
  std::uint64_t instructions_ = 0;
  int ended_ = -1;
};

std::vector<char> bytes_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int run(const char* elf, const char* input) {
  constexpr std::uint32_t kInput = 0x82000000;  // firmware/bench/input.hpp
  constexpr std::uint64_t kMaxTicks = 20'000'000'000;
  Machine machine;
  if (!machine.load(bytes_of(elf))) {
    std::fprintf(stderr, "%s: is no program for RV32 within the machine's RAM; build the target firmware\n", elf);
    return 2;
  }
  if (input != nullptr) {
    const std::vector<char> bytes = bytes_of(input);
    if (bytes.empty() || !machine.put(kInput, bytes, 0, bytes.size())) {
      std::fprintf(stderr, "%s: cannot be read\n", input);
      return 2;
    }
  }
  const int code = machine.run(kMaxTicks);
  std::fflush(stdout);
  std::fprintf(stderr, "%llu instructions, %llu cycles, %.3f each\n",
               static_cast<unsigned long long>(machine.instructions()),
               static_cast<unsigned long long>(machine.cycles()),
               static_cast<double>(machine.cycles()) / static_cast<double>(machine.instructions()));
  if (code < 0) std::fprintf(stderr, "not ended after %llu cycles\n", static_cast<unsigned long long>(kMaxTicks));
  return code < 0 ? 124 : code;
}

}  // namespace
}  // namespace pharos::rtl

int main(int count, char** values) {
  if (count < 2 || count > 3) {
    std::fprintf(stderr, "usage: core_program ELF [INPUT-OF-A-MEASURING-PROGRAM]\n");
    return 2;
  }
  return pharos::rtl::run(values[1], count == 3 ? values[2] : nullptr);
}
