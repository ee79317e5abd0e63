// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <vector>

#include "host/vision/slam/slam_system.hpp"
#include "host/vision/slam/stereo_frontend.hpp"

namespace pharos::slam {

class Stopwatch {
 public:
  double ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Statistics of a run: number of frames of each kind, and medians over the last 2048 frames at least; a run may be
/// endless.
class RunFigures {
 public:
  void add_frame(const TrackedFrame& frame, const StereoFrontend::Result& seen, double took_ms);
  void add_keyframe() { ++counts_.keyframes_made; }
  void add_mapping(double took_ms);
  void add_loop(double took_ms);
  void set_loops_refused(int count, const LoopCounts& candidates) {
    counts_.loops_refused = count;
    counts_.loop_candidates = candidates;
  }

  int frames() const { return counts_.frames; }
  /// Without the figures of the map.
  SlamReport report() const;

 private:
  SlamReport counts_;
  std::vector<float> features_, inliers_, tracking_ms_, mapping_ms_;
};

}  // namespace pharos::slam
