// SPDX-License-Identifier: Apache-2.0
// A short program for the chip of firmware/rtl/soc: sends its number without end, after it has found all its words
// whole.
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/board/chip/addresses.hpp"
#include "firmware/board/rv32/mmio.hpp"

namespace {

using namespace pharos;

constexpr std::size_t kWords = 1024;
constexpr std::uint32_t kFirst = PHAROS_PROBE_PATCH;
constexpr std::uint32_t next_word(std::uint32_t word) { return word * 1664525 + 1013904223; }
constexpr std::array<std::uint32_t, kWords> make_words() {
  std::array<std::uint32_t, kWords> words{};
  std::uint32_t word = kFirst;
  for (std::uint32_t& w : words) w = word = next_word(word);
  return words;
}
constexpr std::array<std::uint32_t, kWords> kMade = make_words();

bool is_whole() {
  // volatile: read from memory, not from the compiler's constants.
  const volatile std::uint32_t* words = kMade.data();
  std::uint32_t word = kFirst;
  for (std::size_t i = 0; i < kWords; ++i) {
    word = next_word(word);
    if (words[i] != word) return false;
  }
  return true;
}

}  // namespace

int main() {
  while (!is_whole()) {
  }
  for (;;) {
    while ((board::mmio32(board::kUart + 20) & 0x20) == 0) {
    }
    board::mmio32(board::kUart) = 0xA0 + PHAROS_PROBE_PATCH;
  }
}
