// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/ticks.hpp"

namespace pharos::host {

/// Converts the tick columns of a recording to 64-bit time, for 32-bit readings and for unwrapped ones.
///
/// A step between two readings that both fit 32 bits is taken as the nearest one modulo 2^32 (a wrap; in an unwrapped
/// file the result is the same unless there was no light for more than 42.9 s). As soon as a reading does not fit 32
/// bits the file is known to be unwrapped and steps count as written.
class TickColumn {
 public:
  /// Time of a row's rise.
  std::int64_t rise(std::int64_t reading) {
    if (!started_) {
      started_ = true;
      time_ = reading;
    } else {
      time_ += step(reading, reading_);
    }
    reading_ = reading;
    return time_;
  }
  /// Time of the same row's fall.
  std::int64_t fall(std::int64_t reading) { return time_ + step(reading, reading_); }

 private:
  static bool fits_32_bits(std::int64_t reading) { return reading >= 0 && reading <= UINT32_MAX; }
  std::int64_t step(std::int64_t later, std::int64_t earlier) {
    unwrapped_file_ = unwrapped_file_ || !fits_32_bits(later) || !fits_32_bits(earlier);
    if (unwrapped_file_) return later - earlier;
    return ticks_difference(static_cast<std::uint32_t>(later), static_cast<std::uint32_t>(earlier));
  }

  std::int64_t time_ = 0;
  std::int64_t reading_ = 0;
  bool started_ = false;
  bool unwrapped_file_ = false;
};

}  // namespace pharos::host
