// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace pharos::wire {

/// Times on the wire lie within +-45 years of the counter's zero, so that no sum, difference or conversion to
/// nanoseconds of them can overflow.
inline constexpr std::int64_t kMaxTicks = std::int64_t{1} << 56;
constexpr bool is_plausible_time(std::int64_t ticks) { return ticks >= -kMaxTicks && ticks <= kMaxTicks; }

/// Writes little-endian fields one after the other into bytes the caller owns.
///
/// Nothing is ever written past the end: the first field that does not fit makes the writer fail for good, and size()
/// is then 0.
class ByteWriter {
 public:
  explicit ByteWriter(std::span<std::uint8_t> out) : out_(out) {}

  template <class T>
  void put(T value) {
    if constexpr (std::is_same_v<T, double>) {
      put(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<T, float>) {
      put(std::bit_cast<std::uint32_t>(value));
    } else {
      static_assert(std::is_integral_v<T> && !std::is_same_v<T, bool>);
      const auto bits = static_cast<std::uint64_t>(value);
      put_bits(static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32), sizeof(T));
    }
  }
  void put_bytes(std::span<const std::uint8_t> bytes) {
    if (!reserve(bytes.size())) return;
    std::copy(bytes.begin(), bytes.end(), out_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += bytes.size();
  }
  /// Signed number as zigzag varint: small magnitudes take few bytes (1 up to 63, 2 up to 8191, …, at most 10).
  void put_varint(std::int64_t value) {
    auto bits = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
    for (; bits >= 0x80; bits >>= 7) put(static_cast<std::uint8_t>(bits | 0x80));
    put(static_cast<std::uint8_t>(bits));
  }
  void put_ticks(std::int64_t ticks) {
    if (!is_plausible_time(ticks)) fail();
    put(ticks);
  }
  /// The message cannot be written (a field is out of its range).
  void fail() { failed_ = true; }

  bool failed() const { return failed_; }
  std::size_t size() const { return failed_ ? 0 : size_; }
  std::size_t room() const { return failed_ ? 0 : out_.size() - size_; }

 private:
  // One routine for every width, in 32 bits: the target's code is small and its shifts are short.
  void put_bits(std::uint32_t low, std::uint32_t high, std::size_t bytes) {
    if (!reserve(bytes)) return;
    for (std::size_t i = 0; i < bytes; ++i, low >>= 8) {
      if (i == sizeof(low)) low = high;
      out_[size_++] = static_cast<std::uint8_t>(low);
    }
  }
  bool reserve(std::size_t bytes) {
    if (failed_ || out_.size() - size_ < bytes) failed_ = true;
    return !failed_;
  }

  std::span<std::uint8_t> out_;
  std::size_t size_ = 0;
  bool failed_ = false;
};

/// Reads little-endian fields one after the other; the counterpart of ByteWriter.
///
/// Nothing is ever read past the end: from the first missing field on, every field reads as 0 and ran_short() is true.
/// refuse() is for fields with an invalid value.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> in) : in_(in) {}

  template <class T>
  T get() {
    if constexpr (std::is_same_v<T, double>) {
      return std::bit_cast<double>(get<std::uint64_t>());
    } else if constexpr (std::is_same_v<T, float>) {
      return std::bit_cast<float>(get<std::uint32_t>());
    } else {
      static_assert(std::is_integral_v<T> && !std::is_same_v<T, bool>);
      if (!have(sizeof(T))) return T{};
      if constexpr (sizeof(T) <= sizeof(std::uint32_t)) {
        return static_cast<T>(get_bits(sizeof(T)));
      } else {
        const std::uint32_t low = get_bits(sizeof(std::uint32_t));
        return static_cast<T>(std::uint64_t{get_bits(sizeof(T) - sizeof(low))} << 32 | low);
      }
    }
  }
  /// A number that must be finite: NaN and infinity are refused and read as 0.
  template <class T>
  T get_finite() {
    const T value = get<T>();
    if (std::isfinite(value)) return value;
    refuse();
    return T{};
  }
  std::int64_t get_ticks() {
    const auto ticks = get<std::int64_t>();
    if (is_plausible_time(ticks)) return ticks;
    refuse();
    return 0;
  }
  void get_bytes(std::span<std::uint8_t> out) {
    if (!have(out.size())) return;
    std::copy_n(in_.begin() + static_cast<std::ptrdiff_t>(at_), out.size(), out.begin());
    at_ += out.size();
  }
  /// Counterpart of put_varint. Only the shortest form is taken, so that equal values are equal bytes.
  std::int64_t get_varint() {
    std::uint64_t bits = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = get<std::uint8_t>();
      const auto low = static_cast<std::uint64_t>(byte & 0x7F);
      if ((low << shift) >> shift != low) refuse();
      bits |= low << shift;
      if (byte >= 0x80) continue;
      if (byte == 0 && shift > 0) refuse();
      return static_cast<std::int64_t>(bits >> 1) ^ -static_cast<std::int64_t>(bits & 1);
    }
    refuse();
    return 0;
  }
  /// A field had an invalid value.
  void refuse() { refused_ = true; }
  void refuse_if(bool bad) { refused_ = refused_ || bad; }

  bool ran_short() const { return ran_short_; }
  bool refused() const { return refused_; }
  std::size_t remaining() const { return in_.size() - at_; }

 private:
  // `bytes` bytes, at most four, that are present.
  std::uint32_t get_bits(std::size_t bytes) {
    std::uint32_t bits = 0;
    for (std::size_t i = bytes; i > 0; --i) bits = bits << 8 | in_[at_ + i - 1];
    at_ += bytes;
    return bits;
  }
  bool have(std::size_t bytes) {
    if (ran_short_ || remaining() < bytes) ran_short_ = true;
    return !ran_short_;
  }

  std::span<const std::uint8_t> in_;
  std::size_t at_ = 0;
  bool ran_short_ = false;
  bool refused_ = false;
};

}  // namespace pharos::wire
