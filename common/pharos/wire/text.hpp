// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pharos/wire/bytes.hpp"

namespace pharos::wire {

/// A short name of at most N printable ASCII characters; on the wire N bytes, padded with zeros.
template <std::size_t N>
struct Text {
  std::array<char, N> characters{};

  Text() = default;
  /// Truncated at N characters; anything that is not printable ASCII becomes '?'.
  explicit Text(std::string_view text) {
    for (std::size_t i = 0; i < N && i < text.size(); ++i) characters[i] = is_printable(text[i]) ? text[i] : '?';
  }
  std::string_view view() const {
    std::size_t size = 0;
    while (size < N && characters[size] != '\0') ++size;
    return {characters.data(), size};
  }
  bool operator==(const Text&) const = default;

  static constexpr bool is_printable(char c) { return c >= ' ' && c <= '~'; }
};

template <std::size_t N>
void write(const Text<N>& text, ByteWriter& out) {
  for (const char c : text.characters) out.put(static_cast<std::uint8_t>(c));
}

template <std::size_t N>
void read(ByteReader& in, Text<N>& text) {
  bool ended = false;
  for (char& c : text.characters) {
    c = static_cast<char>(in.get<std::uint8_t>());
    ended = ended || c == '\0';
    in.refuse_if(ended ? c != '\0' : !Text<N>::is_printable(c));
  }
}

}  // namespace pharos::wire
