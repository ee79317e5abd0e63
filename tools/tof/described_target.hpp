// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/cameras/docking_target.hpp"
#include "pharos/tof/tof_pose.hpp"

namespace pharos::tools {

/// Collects a target description from frames with all six degrees of freedom: radii, and the connectors that are seen
/// at one place in most frames, X' towards the nearest.
class TargetLearner {
 public:
  void add(const tof::TofPose& pose);
  std::size_t frames() const { return frames_; }
  host::DockingTarget learnt() const;

 private:
  struct Seen {
    std::vector<double> x_m, y_m, height_m, long_m, short_m;
  };

  std::size_t frames_ = 0;
  std::vector<double> outer_m_, inner_m_;
  std::vector<Seen> connectors_;
};

}  // namespace pharos::tools
