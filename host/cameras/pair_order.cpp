// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/pair_order.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::host {

std::string text_of(PairFault fault) {
  switch (fault) {
    case PairFault::kNone:
      return "";
    case PairFault::kExchanged:
      return "left and right images seem to be exchanged: what both show lies on the wrong side";
    case PairFault::kEqual:
      return "left and right image are the same picture: give what two cameras took";
  }
  return "";
}

PairFault pair_fault(const std::array<ImageView<const std::uint16_t>, 2>& images) {
  const auto& [left, right] = images;
  if (left.empty() || !left.same_size(right)) return PairFault::kNone;
  for (std::int32_t v = 0; v < left.height_px; ++v) {
    if (!std::equal(left.row(v), left.row(v) + left.width_px, right.row(v))) return PairFault::kNone;
  }
  return PairFault::kEqual;
}

PairFault pair_fault(const std::array<double, 3>& right_in_left_m) {
  const auto& [right, down, ahead] = right_in_left_m;
  return right < 0.0 && -right > std::hypot(down, ahead) ? PairFault::kExchanged : PairFault::kNone;
}

}  // namespace pharos::host
