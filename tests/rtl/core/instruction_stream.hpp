// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>

namespace pharos::rtl {

/// Instructions by name; the last one is everything that no other row matches.
struct InstructionKind {
  std::string_view name;
  std::uint32_t mask;
  std::uint32_t match;
};
std::size_t kind_of(std::uint32_t word);
extern const std::array<InstructionKind, 60> kInstructionKinds;

/// Random words: instructions of every kind on few registers, so that each often needs the result of the one before;
/// some words are no instruction.
class InstructionStream {
 public:
  explicit InstructionStream(std::uint64_t seed) : random_(seed) {}
  std::uint32_t next();
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_()) % limit; }
  /// Operands: often at the ends of the ranges.
  std::uint32_t value();

 private:
  std::uint32_t number();

  std::mt19937 random_;
};

}  // namespace pharos::rtl
