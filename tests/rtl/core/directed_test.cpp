// SPDX-License-Identifier: Apache-2.0
// Each instruction and each trap once, with the result that the manual gives; the model is compared too.
#include <gtest/gtest.h>

#include <vector>

#include "rtl/core/lockstep.hpp"

namespace pharos::rtl {
namespace {

// Operands in x1 and x2, result in x3.
constexpr std::uint32_t of_registers(std::uint32_t funct7, std::uint32_t funct3) {
  return funct7 << 25 | 2 << 20 | 1 << 15 | funct3 << 12 | 3 << 7 | 0x33;
}
constexpr std::uint32_t of_immediate(std::uint32_t immediate, std::uint32_t funct3, std::uint32_t opcode = 0x13) {
  return (immediate & 0xFFF) << 20 | 1 << 15 | funct3 << 12 | 3 << 7 | opcode;
}
constexpr std::uint32_t branch_of(std::uint32_t funct3) { return 2 << 20 | 1 << 15 | funct3 << 12 | 16 << 7 | 0x63; }
constexpr std::uint32_t store_of(std::uint32_t funct3, std::uint32_t offset) {
  return 2 << 20 | 1 << 15 | funct3 << 12 | offset << 7 | 0x23;
}
constexpr std::uint32_t csr_of(std::uint32_t number, std::uint32_t funct3) {
  return number << 20 | 1 << 15 | funct3 << 12 | 3 << 7 | 0x73;
}
constexpr std::uint32_t kReset = 0x80000000;
constexpr std::uint32_t kNop = 0x13;
constexpr std::uint32_t kOld = 0x01DBA5E5;  // in x3 before

struct Row {
  const char* name;
  std::uint32_t word;
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t result;
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class Directed : public testing::Test {
 protected:
  /// Runs `words` from the reset address with x1, x2, as many instructions as there are words or `count`.
  void run(const std::vector<std::uint32_t>& words, std::uint32_t a, std::uint32_t b, std::uint64_t count = 0) {
    for (std::uint32_t i = 0; i < RepeatedMemory::kWords; ++i) bench_.memory().code(4 * i) = kNop;
    for (std::uint32_t i = 0; i < words.size(); ++i) bench_.memory().code(kReset + 4 * i) = words[i];
    std::array<std::uint32_t, 32> registers{};
    registers[0] = 0xDEADBEEF;  // block RAM may hold anything there
    registers[1] = a;
    registers[2] = b;
    registers[3] = kOld;
    bench_.reset(registers);
    const Lockstep::Options quiet{0, 0, false};
    ASSERT_TRUE(bench_.run(count != 0 ? count : words.size(), quiet)) << bench_.difference();
  }
  const ProcessorState& state() { return bench_.model_state(); }
  void expect_trap(std::uint32_t cause, std::uint32_t value, std::uint32_t address = kReset) {
    EXPECT_EQ(state().mcause, cause);
    EXPECT_EQ(state().mtval, value);
    EXPECT_EQ(state().mepc, address);
    EXPECT_EQ(state().pc, state().mtvec);
    EXPECT_EQ(state().x[3], kOld);
  }
  Lockstep bench_{1};
};

class Result : public Directed, public testing::WithParamInterface<Row> {};

TEST_P(Result, IsThatOfTheManual) {
  const Row& row = GetParam();
  run({row.word}, row.a, row.b);
  EXPECT_EQ(state().x[3], row.result);
  EXPECT_EQ(state().pc, kReset + 4);
}

constexpr std::uint32_t kMin = 0x80000000;
constexpr std::uint32_t kMinusOne = 0xFFFFFFFF;
INSTANTIATE_TEST_SUITE_P(
    Of, Result,
    testing::Values(
        Row{"add", of_registers(0, 0), 7, kMinusOne, 6}, Row{"sub", of_registers(32, 0), 5, 7, 0xFFFFFFFE},
        Row{"sll", of_registers(0, 1), 3, 33, 6}, Row{"slt", of_registers(0, 2), kMinusOne, 1, 1},
        Row{"slt, not", of_registers(0, 2), 1, kMin, 0}, Row{"sltu", of_registers(0, 3), 1, kMinusOne, 1},
        Row{"sltu, not", of_registers(0, 3), 5, 5, 0}, Row{"xor", of_registers(0, 4), 0xFF00, 0x0FF0, 0xF0F0},
        Row{"srl", of_registers(0, 5), kMin, 31, 1}, Row{"sra", of_registers(32, 5), kMin, 31, kMinusOne},
        Row{"or", of_registers(0, 6), 0xFF00, 0x0FF0, 0xFFF0}, Row{"and", of_registers(0, 7), 0xFF00, 0x0FF0, 0x0F00},
        Row{"addi", of_immediate(0x800, 0), 1, 0, 0xFFFFF801}, Row{"slti", of_immediate(0xFFF, 2), kMin, 0, 1},
        Row{"sltiu", of_immediate(0xFFF, 3), 5, 0, 1}, Row{"xori", of_immediate(0xFFF, 4), 0xF0, 0, 0xFFFFFF0F},
        Row{"ori", of_immediate(0x7FF, 6), 0x800, 0, 0xFFF}, Row{"andi", of_immediate(0xF0F, 7), 0xFFFF, 0, 0xFF0F},
        Row{"slli", of_immediate(31, 1), 3, 0, kMin}, Row{"srli", of_immediate(4, 5), 0xF0000000, 0, 0x0F000000},
        Row{"srai", of_immediate(0x404, 5), 0xF0000000, 0, 0xFF000000},
        Row{"mul", of_registers(1, 0), 0x10001, 0x10001, 0x20001},
        Row{"mulh", of_registers(1, 1), kMin, kMin, 0x40000000},
        Row{"mulh, mixed", of_registers(1, 1), kMinusOne, 2, kMinusOne},
        Row{"mulhsu", of_registers(1, 2), kMinusOne, kMinusOne, kMinusOne},
        Row{"mulhu", of_registers(1, 3), kMinusOne, kMinusOne, 0xFFFFFFFE},
        Row{"div", of_registers(1, 4), static_cast<std::uint32_t>(-7), 2, static_cast<std::uint32_t>(-3)},
        Row{"div by zero", of_registers(1, 4), static_cast<std::uint32_t>(-7), 0, kMinusOne},
        Row{"div, overflow", of_registers(1, 4), kMin, kMinusOne, kMin},
        Row{"divu", of_registers(1, 5), kMinusOne, 16, 0x0FFFFFFF},
        Row{"divu by zero", of_registers(1, 5), 7, 0, kMinusOne},
        Row{"rem", of_registers(1, 6), static_cast<std::uint32_t>(-7), 2, kMinusOne},
        Row{"rem by zero", of_registers(1, 6), static_cast<std::uint32_t>(-7), 0, static_cast<std::uint32_t>(-7)},
        Row{"rem, overflow", of_registers(1, 6), kMin, kMinusOne, 0},
        Row{"remu", of_registers(1, 7), kMinusOne, 16, 15}, Row{"remu by zero", of_registers(1, 7), 7, 0, 7},
        Row{"lui", 0xABCDE1B7, 9, 9, 0xABCDE000}, Row{"auipc", 0x00001197, 9, 9, kReset + 0x1000},
        Row{"fence", 0x0FF0000F, 1, 2, kOld}, Row{"fence.i", 0x0000100F, 1, 2, kOld},
        Row{"wfi", 0x10500073, 1, 2, kOld}, Row{"csrr", csr_of(0x300, 2) & ~0xF8000U, 1, 2, 0x1800}));

TEST_F(Directed, RegisterZeroStaysZero) {
  run({0x00100013, 0x000001B3}, 1, 2);  // addi x0, x0, 1; add x3, x0, x0
  EXPECT_EQ(state().x[3], 0u);
}

TEST_F(Directed, LoadsTakeTheirBytesAndExtendThem) {
  struct Case {
    std::uint32_t funct3, address, value;
  };
  for (const Case& c :
       {Case{0, 0x101, 0xFFFFFF85}, Case{0, 0x100, 0x76}, Case{1, 0x102, 0xFFFFA394}, Case{2, 0x100, 0xA3948576},
        Case{4, 0x103, 0xA3}, Case{5, 0x100, 0x8576}, Case{4, 0x102, 0x94}}) {
    bench_.memory().data(0x100) = 0xA3948576;
    run({of_immediate(0x010, c.funct3, 0x03)}, c.address - 0x10, 0);
    EXPECT_EQ(state().x[3], c.value) << c.funct3 << " " << c.address;
  }
}

TEST_F(Directed, StoresTouchTheirBytesOnly) {
  struct Case {
    std::uint32_t funct3, address, word;
  };
  for (const Case& c : {Case{0, 0x203, 0x44BBCCDD}, Case{0, 0x200, 0xAABBCC44}, Case{1, 0x202, 0x3344CCDD},
                        Case{2, 0x200, 0x11223344}}) {
    bench_.memory().data(0x200) = 0xAABBCCDD;
    run({store_of(c.funct3, 4)}, c.address - 4, 0x11223344);
    EXPECT_EQ(bench_.memory().data(0x200), c.word) << c.funct3 << " " << c.address;
  }
}

TEST_F(Directed, AccessesMayCrossIntoTheNextWord) {
  for (std::uint32_t offset = 0; offset < 4; ++offset) {
    bench_.memory().data(0x100) = 0x33221100;
    bench_.memory().data(0x104) = 0x77665544;
    run({of_immediate(0, 2, 0x03)}, 0x100 + offset, 0);
    EXPECT_EQ(state().x[3], static_cast<std::uint32_t>(0x7766554433221100 >> 8 * offset));
    run({of_immediate(0, 5, 0x03)}, 0x100 + offset, 0);
    EXPECT_EQ(state().x[3], 0xFFFFU & static_cast<std::uint32_t>(0x7766554433221100 >> 8 * offset));
    run({store_of(2, 0)}, 0x100 + offset, 0xDDCCBBAA);
    const std::uint64_t words = std::uint64_t{bench_.memory().data(0x104)} << 32 | bench_.memory().data(0x100);
    const std::uint64_t mask = std::uint64_t{0xFFFFFFFF} << 8 * offset;
    EXPECT_EQ(words, (0x7766554433221100 & ~mask) | std::uint64_t{0xDDCCBBAA} << 8 * offset);
  }
}

TEST_F(Directed, ARefusedUpperWordTrapsAtTheAccess) {
  run({of_immediate(0, 2, 0x03)}, 0xBFFFFFFE, 0);
  expect_trap(5, 0xBFFFFFFE);
  run({store_of(2, 0)}, 0xBFFFFFFE, 0x11223344);
  expect_trap(7, 0xBFFFFFFE);
}

TEST_F(Directed, BranchesFollowTheirConditions) {
  struct Case {
    std::uint32_t funct3, a, b;
    bool taken;
  };
  for (const Case& c : {Case{0, 5, 5, true}, Case{0, 5, 6, false}, Case{1, 5, 6, true}, Case{1, 5, 5, false},
                        Case{4, kMin, 1, true}, Case{4, 1, kMin, false}, Case{5, 1, kMin, true}, Case{5, 7, 7, true},
                        Case{5, kMin, 1, false}, Case{6, 1, kMin, true}, Case{6, kMin, 1, false},
                        Case{7, kMin, 1, true}, Case{7, 3, 3, true}, Case{7, 1, kMin, false}}) {
    run({branch_of(c.funct3)}, c.a, c.b);
    EXPECT_EQ(state().pc, kReset + (c.taken ? 16 : 4)) << c.funct3 << " " << c.a << " " << c.b;
  }
}

TEST_F(Directed, JumpsKeepTheReturnAddress) {
  run({0x010001EF}, 0, 0);  // jal x3, 16
  EXPECT_EQ(state().pc, kReset + 16);
  EXPECT_EQ(state().x[3], kReset + 4);
  run({of_immediate(5, 0, 0x67)}, kReset + 0x100, 0);  // bit 0 of the target is cleared
  EXPECT_EQ(state().pc, kReset + 0x104);
  EXPECT_EQ(state().x[3], kReset + 4);
}

TEST_F(Directed, ControlRegistersAreWrittenSetAndCleared) {
  run({csr_of(0x343, 1), csr_of(0x343, 2), csr_of(0x343, 3)}, 0xF0F0, 0);
  EXPECT_EQ(state().x[3], 0xF0F0u);
  EXPECT_EQ(state().mtval, 0u);
  run({csr_of(0x343, 5), csr_of(0x343, 6) | 2 << 15, csr_of(0x343, 7)}, 0, 0);  // rs1 is the value: 1, 3, 1
  EXPECT_EQ(state().x[3], 3u);
  EXPECT_EQ(state().mtval, 2u);
}

TEST_F(Directed, CountersCount) {
  run({kNop, kNop, csr_of(0xC02, 2) & ~0xF8000U}, 0, 0);
  EXPECT_EQ(state().x[3], 2u);
}

TEST_F(Directed, TrapsTellCauseAddressAndValue) {
  const std::uint32_t rd_of_load = of_immediate(0, 2, 0x03);
  run({0x00000073}, 0, 0);
  expect_trap(11, 0);
  run({0x00100073}, 0, 0);
  expect_trap(3, 0);
  run({0xFFFFFFFF}, 0, 0);
  expect_trap(2, 0xFFFFFFFF);
  run({csr_of(0x340, 1)}, 0, 0);  // a control register that does not exist
  expect_trap(2, csr_of(0x340, 1));
  run({csr_of(0xC00, 1)}, 0, 0);  // one that cannot be written
  expect_trap(2, csr_of(0xC00, 1));
  run({rd_of_load}, 0xC0000100, 0);
  expect_trap(5, 0xC0000100);
  run({store_of(2, 0)}, 0xC0000100, 0);
  expect_trap(7, 0xC0000100);
  run({0x006001EF}, 0, 0);  // jal x3, 6
  expect_trap(0, kReset + 6);
  run({of_immediate(2, 0, 0x67)}, 0xA0000000, 0);
  expect_trap(0, 0xA0000002);
}

TEST_F(Directed, AFetchThatIsRefusedTrapsAtItsTarget) {
  run({of_immediate(0, 0, 0x67)}, 0xA0000100, 0, 2);
  EXPECT_EQ(state().mcause, 1u);
  EXPECT_EQ(state().mepc, 0xA0000100u);
  EXPECT_EQ(state().mtval, 0xA0000100u);
}

TEST_F(Directed, AReturnRestoresTheInterruptEnable) {
  // mtvec = x1; MIE on; ECALL; there: mepc = x2; MRET.
  run({csr_of(0x305, 1), 0x30046073, 0x00000073}, kReset + 0x40, kReset + 0x80, 3);
  EXPECT_FALSE(state().mie);
  EXPECT_TRUE(state().mpie);
  std::vector<std::uint32_t> words{csr_of(0x305, 1), 0x30046073, 0x00000073};
  words.resize(16, kNop);
  words.push_back(0x34111073);  // csrw mepc, x2
  words.push_back(0x30200073);
  run(words, kReset + 0x40, kReset + 0x80, 5);
  EXPECT_EQ(state().pc, kReset + 0x80);
  EXPECT_TRUE(state().mie);
  EXPECT_TRUE(state().mpie);
}

}  // namespace
}  // namespace pharos::rtl
