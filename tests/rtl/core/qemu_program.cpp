// SPDX-License-Identifier: Apache-2.0
#include "rtl/core/qemu_program.hpp"

#include <array>

#include "rtl/core/instruction_stream.hpp"

namespace pharos::rtl {
namespace {

// Registers of the program itself.
constexpr std::uint32_t kLink = 28;
constexpr std::uint32_t kWord = 29;
constexpr std::uint32_t kScratch = 30;  // the middle of it: offsets have signs
constexpr std::uint32_t kUart = 31;
constexpr std::uint32_t kFree = 28;  // numbers below are the random instructions'
constexpr std::uint32_t kNop = 0x13;

class Assembler {
 public:
  explicit Assembler(std::uint64_t seed) : stream_(seed) {}

  std::vector<std::uint32_t> program(std::uint32_t blocks, std::uint32_t block_instructions) {
    put(0x0000006F);  // over the subroutines, filled in below
    handler_ = here();
    handler();
    dump_ = here();
    dump();
    words_[0] = jump(0, here());
    set(kUart, kQemuUart);
    set(kScratch, kQemuMemory + kScratchOffset + kScratchBytes / 2);
    set(kWord, kQemuMemory + handler_);
    put(csr(0x305, 1, kWord, 0));
    for (std::uint32_t i = 1; i < kFree; ++i) set(i, stream_.value());
    for (std::uint32_t i = 0; i < blocks; ++i) block(block_instructions);
    end();
    words_.resize(kScratchOffset / 4, kNop);
    for (std::uint32_t i = 0; i < kScratchBytes / 4; ++i) put(stream_.value());
    return words_;
  }

 private:
  static std::uint32_t immediate(std::uint32_t value, std::uint32_t rs1, std::uint32_t funct3, std::uint32_t rd,
                                 std::uint32_t opcode) {
    return value << 20 | rs1 << 15 | funct3 << 12 | rd << 7 | opcode;
  }
  static std::uint32_t csr(std::uint32_t number, std::uint32_t funct3, std::uint32_t rs1, std::uint32_t rd) {
    return immediate(number, rs1, funct3, rd, 0x73);
  }
  static std::uint32_t jump(std::uint32_t from, std::uint32_t to, std::uint32_t link = 0) {
    const std::uint32_t by = to - from;
    return (by >> 20 & 1) << 31 | (by >> 1 & 1023) << 21 | (by >> 11 & 1) << 20 | (by >> 12 & 255) << 12 | link << 7 |
           0x6F;
  }
  std::uint32_t here() const { return static_cast<std::uint32_t>(4 * words_.size()); }
  void put(std::uint32_t word) { words_.push_back(word); }
  void set(std::uint32_t rd, std::uint32_t value) {
    put(((value + 0x800) & 0xFFFFF000) | rd << 7 | 0x37);
    put(immediate(value & 0xFFF, rd, 0, rd, 0x13));
  }
  /// kWord to the UART.
  void send() {
    for (int i = 0; i < 4; ++i) {
      put(kWord << 20 | kUart << 15 | 0x23);     // sb
      put(immediate(8, kWord, 5, kWord, 0x13));  // srli
    }
  }
  void handler() {
    for (const std::uint32_t number : {0x342u, 0x343u, 0x341u, 0x300u}) {
      put(csr(number, 2, 0, kWord));
      if (number == 0x300) put(immediate(0x88, kWord, 7, kWord, 0x13));  // andi: MIE and MPIE
      send();
    }
    put(csr(0x341, 2, 0, kWord));
    put(immediate(4, kWord, 0, kWord, 0x13));
    put(csr(0x341, 1, kWord, 0));
    put(0x30200073);  // mret
  }
  void dump() {
    for (std::uint32_t i = 1; i < kFree; ++i) {
      put(immediate(0, i, 0, kWord, 0x13));
      send();
    }
    put(immediate(0, kLink, 0, 0, 0x67));
  }
  void block(std::uint32_t instructions) {
    for (std::uint32_t i = 0; i < instructions; ++i) put(random_instruction());
    for (int i = 0; i < 4; ++i) put(kNop);  // targets of the last jumps
    put(jump(here(), dump_, kLink));
  }
  std::uint32_t random_instruction() {
    constexpr std::array<std::uint32_t, 6> kTrapping{0x00000073, 0x00100073, 0x0000000B,
                                                     0x00003003, 0x7C002073, 0xC0101073};
    for (;;) {
      std::uint32_t word = stream_.next();
      const std::uint32_t opcode = word & 0x7F;
      const std::string_view name = kInstructionKinds[kind_of(word)].name;
      if (name == "other" || name[0] == 'r' || opcode == 0x73 || opcode == 0x67) {
        // One of the traps, the interrupt enable, or a control register that both have whole.
        switch (stream_.below(8)) {
          case 0:
            return kTrapping[stream_.below(kTrapping.size())];
          case 1:
            return stream_.below(2) == 0 ? 0x30046073 : 0x30047073;
          case 2:
            return csr(0x343, 1 + stream_.below(3), stream_.below(kFree), stream_.below(kFree));
          default:
            continue;
        }
      }
      if ((word >> 7 & 31) >= kFree && opcode != 0x23 && opcode != 0x63) continue;
      if (opcode == 0x6F) return jump(0, 4 * (1 + stream_.below(4)), stream_.below(kFree));
      if (opcode == 0x63) return (word & 0x01FFF07F) | 4 * (1 + stream_.below(4)) << 7;
      const std::uint32_t size = 1U << (word >> 12 & 3);
      const std::uint32_t offset = stream_.below(4096) & ~(size - 1) & 0xFFF;
      if (opcode == 0x03) return immediate(offset, kScratch, word >> 12 & 7, word >> 7 & 31, opcode);
      if (opcode == 0x23) return (word & 0x01F0707F) | kScratch << 15 | (offset & 31) << 7 | (offset >> 5) << 25;
      return word;
    }
  }
  void end() {
    set(kScratch, kQemuMemory + kScratchOffset);
    set(kLink, kQemuMemory + kScratchOffset + kScratchBytes);
    const std::uint32_t loop = here();
    put(immediate(0, kScratch, 2, kWord, 0x03));
    send();
    put(immediate(4, kScratch, 0, kScratch, 0x13));
    const std::uint32_t back = loop - here();
    put((back >> 12 & 1) << 31 | (back >> 5 & 63) << 25 | kLink << 20 | kScratch << 15 | 1 << 12 |
        (back >> 1 & 15) << 8 | (back >> 11 & 1) << 7 | 0x63);  // bne
    set(kScratch, kQemuEnd);
    set(kWord, 0x5555);
    put(kWord << 20 | kScratch << 15 | 2 << 12 | 0x23);
    put(jump(0, 0));
  }

  InstructionStream stream_;
  std::vector<std::uint32_t> words_;
  std::uint32_t handler_ = 0;
  std::uint32_t dump_ = 0;
};

}  // namespace

std::vector<std::uint32_t> qemu_program(std::uint64_t seed, std::uint32_t blocks, std::uint32_t block_instructions) {
  return Assembler(seed).program(blocks, block_instructions);
}

}  // namespace pharos::rtl
