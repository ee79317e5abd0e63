// SPDX-License-Identifier: Apache-2.0
#include "rtl/core/instruction_stream.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kOpcode = 0x7F;
constexpr std::uint32_t kFunct3 = 0x707F;
constexpr std::uint32_t kFunct7 = 0xFE00707F;
constexpr std::uint32_t kWhole = 0xFFFFFFFF;

}  // namespace

const std::array<InstructionKind, 60> kInstructionKinds{{
    {"lui", kOpcode, 0x37},
    {"auipc", kOpcode, 0x17},
    {"jal", kOpcode, 0x6F},
    {"jalr", kFunct3, 0x67},
    {"beq", kFunct3, 0x63},
    {"bne", kFunct3, 0x1063},
    {"blt", kFunct3, 0x4063},
    {"bge", kFunct3, 0x5063},
    {"bltu", kFunct3, 0x6063},
    {"bgeu", kFunct3, 0x7063},
    {"lb", kFunct3, 0x03},
    {"lh", kFunct3, 0x1003},
    {"lw", kFunct3, 0x2003},
    {"lbu", kFunct3, 0x4003},
    {"lhu", kFunct3, 0x5003},
    {"sb", kFunct3, 0x23},
    {"sh", kFunct3, 0x1023},
    {"sw", kFunct3, 0x2023},
    {"addi", kFunct3, 0x13},
    {"slti", kFunct3, 0x2013},
    {"sltiu", kFunct3, 0x3013},
    {"xori", kFunct3, 0x4013},
    {"ori", kFunct3, 0x6013},
    {"andi", kFunct3, 0x7013},
    {"slli", kFunct7, 0x1013},
    {"srli", kFunct7, 0x5013},
    {"srai", kFunct7, 0x40005013},
    {"add", kFunct7, 0x33},
    {"sub", kFunct7, 0x40000033},
    {"sll", kFunct7, 0x1033},
    {"slt", kFunct7, 0x2033},
    {"sltu", kFunct7, 0x3033},
    {"xor", kFunct7, 0x4033},
    {"srl", kFunct7, 0x5033},
    {"sra", kFunct7, 0x40005033},
    {"or", kFunct7, 0x6033},
    {"and", kFunct7, 0x7033},
    {"mul", kFunct7, 0x2000033},
    {"mulh", kFunct7, 0x2001033},
    {"mulhsu", kFunct7, 0x2002033},
    {"mulhu", kFunct7, 0x2003033},
    {"div", kFunct7, 0x2004033},
    {"divu", kFunct7, 0x2005033},
    {"rem", kFunct7, 0x2006033},
    {"remu", kFunct7, 0x2007033},
    {"fence", kFunct3, 0x0F},
    {"fence.i", kFunct3, 0x100F},
    {"ecall", kWhole, 0x73},
    {"ebreak", kWhole, 0x100073},
    {"mret", kWhole, 0x30200073},
    {"wfi", kWhole, 0x10500073},
    {"csrrw", kFunct3, 0x1073},
    {"csrrs", kFunct3, 0x2073},
    {"csrrc", kFunct3, 0x3073},
    {"csrrwi", kFunct3, 0x5073},
    {"csrrsi", kFunct3, 0x6073},
    {"csrrci", kFunct3, 0x7073},
    {"reserved load", kFunct3, 0x3003},
    {"reserved store", kFunct3, 0x3023},
    {"other", 0, 0},
}};

std::size_t kind_of(std::uint32_t word) {
  std::size_t kind = 0;
  while ((word & kInstructionKinds[kind].mask) != kInstructionKinds[kind].match) ++kind;
  return kind;
}

std::uint32_t InstructionStream::value() {
  constexpr std::array<std::uint32_t, 8> kEnds{0, 1, 2, 0x7FFFFFFF, 0x80000000, 0x80000001, 0xFFFFFFFE, 0xFFFFFFFF};
  const std::uint32_t word = static_cast<std::uint32_t>(random_());
  switch (below(4)) {
    case 0:
      return kEnds[below(kEnds.size())];
    case 1:
      return word >> below(32);
    case 2:
      return static_cast<std::uint32_t>(-static_cast<std::int32_t>(word >> below(32)));
    default:
      return word;
  }
}

std::uint32_t InstructionStream::number() { return below(8) == 0 ? below(32) : below(6); }

std::uint32_t InstructionStream::next() {
  constexpr std::array<std::uint32_t, 16> kControlRegisters{0x300, 0x300, 0x304, 0x304, 0x305, 0x341, 0x342, 0x343,
                                                            0x344, 0xC00, 0xC02, 0xC80, 0xC82, 0xC01, 0x340, 0xF14};
  if (below(64) == 0) return static_cast<std::uint32_t>(random_());
  // Frequent ones four times as often as the others; the last row is the word above.
  std::size_t kind = below(kInstructionKinds.size() - 1);
  const auto rare = [](const InstructionKind& row) {
    return row.mask == kWhole || row.name[0] == 'r' || row.match == 0x0F || row.match == 0x100F;
  };
  while (rare(kInstructionKinds[kind]) && below(4) != 0) kind = below(kInstructionKinds.size() - 1);
  const InstructionKind& row = kInstructionKinds[kind];
  std::uint32_t fields = static_cast<std::uint32_t>(random_()) & 0xFE000000;
  fields |= number() << 7 | number() << 15 | number() << 20;
  const std::uint32_t opcode = row.match & kOpcode;
  const bool is_load = opcode == 0x03;
  const bool is_store = opcode == 0x23;
  if ((is_load || is_store) && below(2) == 0) fields &= ~(31U << 15);  // relative to 0
  // Mostly aligned.
  if (is_load && below(4) != 0) fields &= ~(3U << 20);
  if (is_store && below(4) != 0) fields &= ~(3U << 7);
  if (opcode == 0x67 || opcode == 0x6F) fields = (fields & ~(3U << 20)) | (below(16) == 0 ? 2U << 20 : 0);
  if (opcode == 0x63) fields = (fields & ~(3U << 7)) | (below(16) == 0 ? 2U << 7 : 0) | (below(2) << 7);
  if (opcode == 0x67 && below(2) == 0) fields &= ~(31U << 15);
  if (opcode == 0x17 || opcode == 0x37 || opcode == 0x6F) fields |= below(256) << 12;
  if (opcode == 0x73) fields = (fields & 0xFFFFF) | kControlRegisters[below(kControlRegisters.size())] << 20;
  const std::uint32_t word = (fields & ~row.mask) | row.match;
  return below(32) == 0 ? word ^ 1U << below(32) : word;  // nearly an instruction
}

}  // namespace pharos::rtl
