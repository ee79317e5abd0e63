// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <span>
#include <type_traits>

namespace pharos::test {

/// One line of results for compare.py: a key, then integers in decimal, bytes as b<hexadecimal> and reals as x<their
/// 64 bits>, so that nothing is lost in print.
class ResultLine {
 public:
  explicit ResultLine(const char* key) { std::printf("%s", key); }
  ResultLine(const ResultLine&) = delete;
  ResultLine& operator=(const ResultLine&) = delete;
  ~ResultLine() { std::printf("\n"); }

  template <class T>
  requires std::is_integral_v<T> ResultLine& operator<<(T value) {
    std::printf(" %lld", static_cast<long long>(value));
    return *this;
  }
  ResultLine& operator<<(double value) {
    std::printf(" x%016llx", static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
    return *this;
  }
  ResultLine& operator<<(std::span<const std::uint8_t> bytes) {
    std::printf(" b");
    for (const std::uint8_t byte : bytes) std::printf("%02x", static_cast<unsigned>(byte));
    return *this;
  }
};

}  // namespace pharos::test
