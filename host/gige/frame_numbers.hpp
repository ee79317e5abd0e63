// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace pharos::host {

/// Follows the block numbers of GigE Vision: 16 bits that wrap from 65535 to 1 (0 is no number), or 64 bits that do not
/// wrap if the camera uses extended block numbers.
class FrameNumbers {
 public:
  /// Maximum rate of block numbers: twice the highest frame rate that the configuration accepts.
  static constexpr double kMaxRate_hz = 200.0;
  /// Tolerance for frames that waited and arrive together.
  static constexpr double kMargin = 8.0;

  /// The count of numbers between the last frame and this one, which arrived at `arrival_ns`: frames of which no packet
  /// was received. Empty, and the state is unchanged, for a number that the camera cannot have sent: one that was
  /// received before, or one further ahead than the elapsed time allows.
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
