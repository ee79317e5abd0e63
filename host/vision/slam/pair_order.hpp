// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "host/vision/slam/stereo_match.hpp"

namespace pharos::slam {

/// Checks on the first pairs with enough features that left and right are not exchanged and that they belong together.
class PairOrder {
 public:
  /// Throws host::NoPairError where the pairs so far are exchanged or do not belong together.
  void add(std::size_t features, const StereoMatchStats& stats);
  /// Enough pairs were checked, without error.
  bool known() const;

 private:
  int pairs_ = 0;
  StereoMatchStats sum_;
};

}  // namespace pharos::slam
