// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "host/vision/slam/stereo_match.hpp"

namespace pharos::slam {

/// Whether left images are left ones, and of one moment and these cameras: told by the first pairs that show enough.
class PairOrder {
 public:
  /// Throws InputError where the pairs so far tell that they are exchanged or do not belong together.
  void add(std::size_t features, const StereoMatchStats& stats);
  /// Enough pairs have been seen, and all is well.
  bool known() const;

 private:
  int pairs_ = 0;
  StereoMatchStats sum_;
};

}  // namespace pharos::slam
