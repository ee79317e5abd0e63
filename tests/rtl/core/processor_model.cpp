// SPDX-License-Identifier: Apache-2.0
#include "rtl/core/processor_model.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kTimerInterrupt = 0x80000007;

std::uint32_t sign_extended(std::uint32_t value, unsigned bits) {
  const std::uint32_t sign = 1U << (bits - 1);
  return ((value & ((sign << 1) - 1)) ^ sign) - sign;
}

std::int64_t as_signed(std::uint32_t value) { return static_cast<std::int32_t>(value); }

std::uint32_t multiplied(unsigned funct3, std::uint32_t a, std::uint32_t b) {
  switch (funct3) {
    case 0:
      return a * b;
    case 1:
      return static_cast<std::uint32_t>((as_signed(a) * as_signed(b)) >> 32);
    case 2:
      return static_cast<std::uint32_t>((as_signed(a) * static_cast<std::int64_t>(b)) >> 32);
    default:
      return static_cast<std::uint32_t>((std::uint64_t{a} * b) >> 32);
  }
}

std::uint32_t divided(unsigned funct3, std::uint32_t a, std::uint32_t b) {
  const bool remainder = (funct3 & 2) != 0;
  if (b == 0) return remainder ? a : UINT32_MAX;
  if ((funct3 & 1) != 0) return remainder ? a % b : a / b;
  return static_cast<std::uint32_t>(remainder ? as_signed(a) % as_signed(b) : as_signed(a) / as_signed(b));
}

}  // namespace

struct ProcessorModel::Instruction {
  explicit Instruction(std::uint32_t bits) : word(bits) {}
  std::uint32_t word;
  unsigned opcode() const { return word & 0x7F; }
  unsigned rd() const { return word >> 7 & 31; }
  unsigned funct3() const { return word >> 12 & 7; }
  unsigned rs1() const { return word >> 15 & 31; }
  unsigned rs2() const { return word >> 20 & 31; }
  unsigned funct7() const { return word >> 25; }
  std::uint32_t i() const { return sign_extended(word >> 20, 12); }
  std::uint32_t s() const { return sign_extended((word >> 25) << 5 | rd(), 12); }
  std::uint32_t u() const { return word & 0xFFFFF000; }
  std::uint32_t b() const {
    return sign_extended((word >> 31) << 12 | (word >> 7 & 1) << 11 | (word >> 25 & 63) << 5 | (word >> 8 & 15) << 1,
                         13);
  }
  std::uint32_t j() const {
    return sign_extended(
        (word >> 31) << 20 | (word >> 12 & 255) << 12 | (word >> 20 & 1) << 11 | (word >> 21 & 1023) << 1, 21);
  }
};

StepResult ProcessorModel::trap(std::uint32_t cause, std::uint32_t value) {
  state_.mpie = state_.mie;
  state_.mie = false;
  state_.mepc = state_.pc;
  state_.mcause = cause;
  state_.mtval = value;
  state_.pc = state_.mtvec;
  return StepResult::kTrapped;
}

void ProcessorModel::interrupt() { (void)trap(kTimerInterrupt, 0); }

StepResult ProcessorModel::retire(std::uint32_t next_pc) {
  state_.pc = next_pc;
  ++state_.instret;
  return StepResult::kRetired;
}

StepResult ProcessorModel::write(unsigned rd, std::uint32_t value) {
  if (rd != 0) state_.x[rd] = value;
  return retire(state_.pc + 4);
}

StepResult ProcessorModel::jump(std::uint32_t target, unsigned rd) {
  if (target % 4 != 0) return trap(0, target);
  if (rd != 0) state_.x[rd] = state_.pc + 4;
  return retire(target);
}

StepResult ProcessorModel::branch(const Instruction& in) {
  const std::uint32_t a = state_.x[in.rs1()];
  const std::uint32_t b = state_.x[in.rs2()];
  bool taken = false;
  switch (in.funct3()) {
    case 0:
      taken = a == b;
      break;
    case 1:
      taken = a != b;
      break;
    case 4:
      taken = as_signed(a) < as_signed(b);
      break;
    case 5:
      taken = as_signed(a) >= as_signed(b);
      break;
    case 6:
      taken = a < b;
      break;
    case 7:
      taken = a >= b;
      break;
    default:
      return illegal(in.word);
  }
  return taken ? jump(state_.pc + in.b(), 0) : retire(state_.pc + 4);
}

// A value whose bytes lie in two words is read and written from the lower one on; what was written stays where the
// upper one is refused.
std::optional<std::uint32_t> ProcessorModel::load_bytes(std::uint32_t address, unsigned size) {
  std::uint32_t value = 0;
  std::optional<std::uint32_t> word;
  for (unsigned i = 0; i < size; ++i) {
    const std::uint32_t at = address + i;
    if (i == 0 || at % 4 == 0) {
      std::uint8_t bytes = 0;
      for (unsigned k = i; k < size && (k == i || (address + k) % 4 != 0); ++k)
        bytes = static_cast<std::uint8_t>(bytes | 1U << (address + k) % 4);
      word = bus_.load(at & ~3U, bytes);
      if (!word) return std::nullopt;
    }
    value |= (*word >> 8 * (at % 4) & 0xFF) << 8 * i;
  }
  return value;
}

bool ProcessorModel::store_bytes(std::uint32_t address, unsigned size, std::uint32_t value) {
  for (unsigned i = 0; i < size;) {
    const std::uint32_t word_address = (address + i) & ~3U;
    std::uint8_t bytes = 0;
    std::uint32_t word = 0;
    for (; i < size && ((address + i) & ~3U) == word_address; ++i) {
      bytes = static_cast<std::uint8_t>(bytes | 1U << (address + i) % 4);
      word |= (value >> 8 * i & 0xFF) << 8 * ((address + i) % 4);
    }
    if (!bus_.store(word_address, bytes, word)) return false;
  }
  return true;
}

StepResult ProcessorModel::load(const Instruction& in) {
  const unsigned size = 1U << (in.funct3() & 3);
  if (size == 8 || in.funct3() == 6) return illegal(in.word);
  const std::uint32_t address = state_.x[in.rs1()] + in.i();
  const auto value = load_bytes(address, size);
  if (!value) return trap(5, address);
  return write(in.rd(), size == 4 || in.funct3() >= 4 ? *value : sign_extended(*value, 8 * size));
}

StepResult ProcessorModel::store(const Instruction& in) {
  if (in.funct3() > 2) return illegal(in.word);
  const std::uint32_t address = state_.x[in.rs1()] + in.s();
  if (!store_bytes(address, 1U << in.funct3(), state_.x[in.rs2()])) return trap(7, address);
  return retire(state_.pc + 4);
}

StepResult ProcessorModel::arithmetic(const Instruction& in) {
  const bool immediate = in.opcode() == 0x13;
  const std::uint32_t a = state_.x[in.rs1()];
  const std::uint32_t b = immediate ? in.i() : state_.x[in.rs2()];
  const unsigned funct3 = in.funct3();
  const bool shift = funct3 == 1 || funct3 == 5;
  const unsigned funct7 = immediate && !shift ? 0 : in.funct7();
  if (!immediate && funct7 == 1) {
    return write(in.rd(), funct3 < 4 ? multiplied(funct3, a, b) : divided(funct3, a, b));
  }
  const bool has_other = funct3 == 5 || (funct3 == 0 && !immediate);
  if (funct7 != 0 && !(funct7 == 32 && has_other)) return illegal(in.word);
  const unsigned by = b & 31;
  switch (funct3) {
    case 0:
      return write(in.rd(), funct7 == 32 ? a - b : a + b);
    case 1:
      return write(in.rd(), a << by);
    case 2:
      return write(in.rd(), as_signed(a) < as_signed(b) ? 1 : 0);
    case 3:
      return write(in.rd(), a < b ? 1 : 0);
    case 4:
      return write(in.rd(), a ^ b);
    case 5:
      return write(in.rd(), funct7 == 32 ? static_cast<std::uint32_t>(as_signed(a) >> by) : a >> by);
    case 6:
      return write(in.rd(), a | b);
    default:
      return write(in.rd(), a & b);
  }
}

std::optional<std::uint32_t> ProcessorModel::read_csr(std::uint32_t number, const ModelInputs& inputs) const {
  switch (number) {
    case 0x300:
      return 0x1800U | (state_.mie ? 8U : 0U) | (state_.mpie ? 0x80U : 0U);
    case 0x304:
      return state_.mtie ? 0x80 : 0;
    case 0x305:
      return state_.mtvec;
    case 0x341:
      return state_.mepc;
    case 0x342:
      return state_.mcause;
    case 0x343:
      return state_.mtval;
    case 0x344:
      return inputs.timer_interrupt ? 0x80 : 0;
    case 0xC00:
      return static_cast<std::uint32_t>(inputs.cycle);
    case 0xC80:
      return static_cast<std::uint32_t>(inputs.cycle >> 32);
    case 0xC02:
      return static_cast<std::uint32_t>(state_.instret);
    case 0xC82:
      return static_cast<std::uint32_t>(state_.instret >> 32);
    default:
      return std::nullopt;
  }
}

void ProcessorModel::write_csr(std::uint32_t number, std::uint32_t value) {
  switch (number) {
    case 0x300:
      state_.mie = (value & 8) != 0;
      state_.mpie = (value & 0x80) != 0;
      break;
    case 0x304:
      state_.mtie = (value & 0x80) != 0;
      break;
    case 0x305:
      state_.mtvec = value & ~3U;
      break;
    case 0x341:
      state_.mepc = value & ~3U;
      break;
    case 0x342:
      state_.mcause = value & 0x8000000F;
      break;
    case 0x343:
      state_.mtval = value;
      break;
    default:
      break;  // mip: set by the timer alone
  }
}

StepResult ProcessorModel::system(const Instruction& in, const ModelInputs& inputs) {
  switch (in.word) {
    case 0x00000073:  // ECALL
      return trap(11, 0);
    case 0x00100073:  // EBREAK
      return trap(3, 0);
    case 0x30200073:  // MRET
      state_.mie = state_.mpie;
      state_.mpie = true;
      return retire(state_.mepc);
    case 0x10500073:  // WFI
      return retire(state_.pc + 4);
    default:
      break;
  }
  const unsigned kind = in.funct3() & 3;
  if (kind == 0) return illegal(in.word);
  const std::uint32_t number = in.word >> 20;
  const std::uint32_t operand = in.funct3() >= 4 ? in.rs1() : state_.x[in.rs1()];
  const bool writes = kind == 1 || in.rs1() != 0;
  const auto old = read_csr(number, inputs);
  if (!old || (writes && number >> 10 == 3)) return illegal(in.word);
  if (writes) write_csr(number, kind == 1 ? operand : kind == 2 ? *old | operand : *old & ~operand);
  return write(in.rd(), *old);
}

StepResult ProcessorModel::step(const ModelInputs& inputs) {
  const auto word = bus_.fetch(state_.pc);
  if (!word) return trap(1, state_.pc);
  const Instruction in{*word};
  switch (in.opcode()) {
    case 0x03:
      return load(in);
    case 0x0F:  // FENCE, FENCE.I: nothing to order here
      return in.funct3() < 2 ? retire(state_.pc + 4) : illegal(in.word);
    case 0x13:
    case 0x33:
      return arithmetic(in);
    case 0x17:
      return write(in.rd(), state_.pc + in.u());
    case 0x23:
      return store(in);
    case 0x37:
      return write(in.rd(), in.u());
    case 0x63:
      return branch(in);
    case 0x67:
      return in.funct3() == 0 ? jump((state_.x[in.rs1()] + in.i()) & ~1U, in.rd()) : illegal(in.word);
    case 0x6F:
      return jump(state_.pc + in.j(), in.rd());
    case 0x73:
      return system(in, inputs);
    default:
      return illegal(in.word);
  }
}

}  // namespace pharos::rtl
