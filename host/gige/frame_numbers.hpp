// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace pharos::host {

/// Follows the block numbers of GigE Vision: 16 bits from 1 to 65535 and round again (0 is none), or 64 bits without
/// end where the camera uses extended numbers.
class FrameNumbers {
 public:
  /// How many numbers lie between the last frame and this one: frames of which no packet came.
  std::int64_t missing_before(std::uint64_t number) {
    constexpr std::uint64_t kNumbers16 = 65'535;
    std::int64_t missing = 0;
    if (last_ && number > *last_) {
      missing = static_cast<std::int64_t>(number - *last_ - 1);
    } else if (last_ && number < *last_ && *last_ <= kNumbers16) {
      missing = static_cast<std::int64_t>(number + kNumbers16 - *last_ - 1);
    }
    // A late frame looks like nearly a whole round: frames are never that late, and a stop of a minute is no loss.
    constexpr std::int64_t kMaxMissing = 32'768;
    if (missing >= kMaxMissing) return 0;
    last_ = number;
    return missing;
  }

 private:
  std::optional<std::uint64_t> last_;
};

}  // namespace pharos::host
