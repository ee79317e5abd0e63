// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::signature {

// Numbers modulo p = 2^255 - 19 as 8 words, the lowest first. Results may be any of the representations below 2^256;
// reduced() gives the one below p. Time depends on the values: for public data only.

using Words = std::array<std::uint32_t, 8>;

inline constexpr Words kPrime = {0xffffffed, 0xffffffff, 0xffffffff, 0xffffffff,
                                 0xffffffff, 0xffffffff, 0xffffffff, 0x7fffffff};

/// a -= b modulo 2^256; true when b was greater.
bool subtract_words(Words& a, const Words& b);

Words plus(const Words& a, const Words& b);
Words minus(const Words& a, const Words& b);
/// Cost: 72 products of two words.
Words times(const Words& a, const Words& b);
/// a to the power whose binary digits are ones from `top` down to 5, then the 5 of `low`.
Words power(const Words& a, int top, std::uint32_t low);
Words reduced(Words a);

}  // namespace pharos::signature
