// SPDX-License-Identifier: Apache-2.0
#include "pharos/signature/field.hpp"

#include <cstddef>

namespace pharos::signature {
namespace {

/// 2^256 = 38 modulo p.
constexpr std::uint32_t kFold = 38;

/// Adds carry * 2^256, until nothing is carried.
void fold(Words& a, std::uint32_t carry) {
  while (carry != 0) {
    std::uint64_t sum = static_cast<std::uint64_t>(carry) * kFold;
    for (std::uint32_t& word : a) {
      sum += word;
      word = static_cast<std::uint32_t>(sum);
      sum >>= 32;
    }
    carry = static_cast<std::uint32_t>(sum);
  }
}

}  // namespace

bool subtract_words(Words& a, const Words& b) {
  std::uint32_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::uint64_t difference = static_cast<std::uint64_t>(a[i]) - b[i] - borrow;
    a[i] = static_cast<std::uint32_t>(difference);
    borrow = static_cast<std::uint32_t>(difference >> 32) & 1;
  }
  return borrow != 0;
}

Words plus(const Words& a, const Words& b) {
  Words result;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += static_cast<std::uint64_t>(a[i]) + b[i];
    result[i] = static_cast<std::uint32_t>(sum);
    sum >>= 32;
  }
  fold(result, static_cast<std::uint32_t>(sum));
  return result;
}

Words minus(const Words& a, const Words& b) {
  Words result = a;
  // What is borrowed is 2^256, 38 too many.
  bool borrowed = subtract_words(result, b);
  while (borrowed) borrowed = subtract_words(result, Words{kFold});
  return result;
}

Words times(const Words& a, const Words& b) {
  std::array<std::uint32_t, 16> product{};
  for (std::size_t i = 0; i < 8; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < 8; ++j) {
      carry += static_cast<std::uint64_t>(a[i]) * b[j] + product[i + j];
      product[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product[i + 8] = static_cast<std::uint32_t>(carry);
  }
  Words result;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    carry += static_cast<std::uint64_t>(product[i + 8]) * kFold + product[i];
    result[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  fold(result, static_cast<std::uint32_t>(carry));
  return result;
}

Words power(const Words& a, int top, std::uint32_t low) {
  Words result = a;
  for (int bit = top - 1; bit >= 0; --bit) {
    result = times(result, result);
    if (bit >= 5 || ((low >> bit) & 1) != 0) result = times(result, a);
  }
  return result;
}

Words reduced(Words a) {
  Words less = a;
  while (!subtract_words(less, kPrime)) a = less;
  return a;
}

}  // namespace pharos::signature
