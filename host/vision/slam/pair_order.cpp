// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pair_order.hpp"

#include "host/cameras/pair_order.hpp"

namespace pharos::slam {
namespace {

constexpr int kPairs = 5;
constexpr std::size_t kMinFeatures = 60;

}  // namespace

bool PairOrder::known() const { return pairs_ >= kPairs; }

void PairOrder::add(std::size_t features, const StereoMatchStats& stats) {
  if (known() || features < kMinFeatures) return;
  sum_.matched += stats.matched;
  sum_.swapped += stats.swapped;
  sum_.off_rows += stats.off_rows;
  ++pairs_;
  if (!known()) return;
  if (sum_.swapped > 2 * sum_.matched) {
    throw host::NoPairError(text_of(host::PairFault::kExchanged));
  }
  if (sum_.off_rows > 2 * sum_.matched) {
    throw host::NoPairError(
        "the images' rows do not agree: left and right are out of step, or the rig file is of other cameras");
  }
}

}  // namespace pharos::slam
