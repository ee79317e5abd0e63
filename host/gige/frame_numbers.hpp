// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace pharos::host {

/// Follows the block numbers of GigE Vision: 16 bits from 1 to 65535 and round again (0 is none), or 64 bits without
/// end where the camera uses extended numbers.
class FrameNumbers {
 public:
  /// Numbers that a camera may count in a second: twice the frames that the configuration takes at the most.
  static constexpr double kMaxRate_hz = 200.0;
  /// And some, for frames that waited together.
  static constexpr double kMargin = 8.0;

  /// How many numbers lie between the last frame and this one, which arrived at `arrival_ns`: frames of which no packet
  /// came. Empty, and nothing changes, where a camera cannot have counted so: a number that was there before, or one
  /// that lies further ahead than frames can have been taken meanwhile.
  std::optional<std::int64_t> missing_before(std::uint64_t number, std::int64_t arrival_ns) {
    constexpr std::uint64_t kNumbers16 = 65'535;
    if (!last_) {
      take(number, arrival_ns);
      return 0;
    }
    const bool round = number < *last_ && *last_ <= kNumbers16;
    if (number == *last_ || (number < *last_ && !round)) return std::nullopt;
    const std::uint64_t steps = round ? number + kNumbers16 - *last_ : number - *last_;
    const double elapsed_s = static_cast<double>(arrival_ns - last_arrival_ns_) * 1e-9;
    if (static_cast<double>(steps) > kMargin + kMaxRate_hz * elapsed_s) return std::nullopt;
    take(number, arrival_ns);
    return static_cast<std::int64_t>(steps) - 1;
  }

 private:
  void take(std::uint64_t number, std::int64_t arrival_ns) {
    last_ = number;
    last_arrival_ns_ = arrival_ns;
  }

  std::optional<std::uint64_t> last_;
  std::int64_t last_arrival_ns_ = 0;
};

}  // namespace pharos::host
