// SPDX-License-Identifier: Apache-2.0
// Runs a program that was linked for QEMU's machine on the Verilated core (program_machine.v). Exit code: the
// program's.
#include <elf.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "rtl/core/program_machine.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kRam = 0x80000000;
constexpr std::uint32_t kInput = 0x82000000;  // firmware/bench/input.hpp
constexpr std::uint64_t kMaxCycles = 100'000'000'000;
constexpr std::uint32_t kPass = 0x5555;
constexpr std::uint32_t kFail = 0x3333;
constexpr int kNotEnded = 124;

bool put(std::span<std::uint32_t> ram, std::uint32_t address, std::span<const char> bytes) {
  const std::uint32_t offset = address - kRam;
  if (address < kRam || bytes.size() > ram.size_bytes() || offset > ram.size_bytes() - bytes.size()) return false;
  std::memcpy(reinterpret_cast<char*>(ram.data()) + offset, bytes.data(), bytes.size());
  return true;
}

/// Loads the parts of an ELF file and, where the processor starts, a jump to its entry.
bool load(std::span<std::uint32_t> ram, std::span<const char> elf) {
  Elf32_Ehdr head;
  if (elf.size() < sizeof head) return false;
  std::memcpy(&head, elf.data(), sizeof head);
  if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_machine != EM_RISCV) return false;
  for (unsigned i = 0; i < head.e_phnum; ++i) {
    Elf32_Phdr part;
    const std::uint64_t at = head.e_phoff + std::uint64_t{i} * sizeof part;
    if (at + sizeof part > elf.size()) return false;
    std::memcpy(&part, &elf[at], sizeof part);
    if (part.p_type != PT_LOAD || part.p_filesz == 0) continue;
    if (std::uint64_t{part.p_offset} + part.p_filesz > elf.size()) return false;
    if (!put(ram, part.p_paddr, elf.subspan(part.p_offset, part.p_filesz))) return false;
  }
  // lui t0, upper; jalr x0, lower(t0)
  const std::uint32_t upper = (head.e_entry + 0x800) & 0xFFFFF000, lower = (head.e_entry - upper) & 0xFFF;
  ram[0] = upper | 0x2B7;
  ram[1] = lower << 20 | 0x28067;
  return true;
}

int run_to_end(ProgramMachine& machine) {
  ProgramEvent event;
  machine.reset();
  while (machine.run(kMaxCycles, event)) {
    if (!event.ended) {
      std::putchar(static_cast<int>(event.word & 0xFF));
      continue;
    }
    if ((event.word & 0xFFFF) == kPass) return 0;
    if ((event.word & 0xFFFF) == kFail) return static_cast<int>(event.word >> 16);
  }
  std::fprintf(stderr, "not ended after %llu cycles\n", static_cast<unsigned long long>(kMaxCycles));
  return kNotEnded;
}

std::vector<char> bytes_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int run(const char* elf, const char* input) {
  const auto machine = make_program_machine();
  if (!load(machine->memory(), bytes_of(elf))) {
    std::fprintf(stderr, "%s: is no program for RV32 within the machine's RAM; build the target firmware\n", elf);
    return 2;
  }
  if (input != nullptr) {
    const std::vector<char> bytes = bytes_of(input);
    if (bytes.empty() || !put(machine->memory(), kInput, bytes)) {
      std::fprintf(stderr, "%s: cannot be read\n", input);
      return 2;
    }
  }
  const int code = run_to_end(*machine);
  std::fflush(stdout);
  std::fprintf(stderr, "%llu instructions, %llu cycles, %.3f each\n",
               static_cast<unsigned long long>(machine->instructions()),
               static_cast<unsigned long long>(machine->cycles()),
               static_cast<double>(machine->cycles()) / static_cast<double>(machine->instructions()));
  return code;
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
