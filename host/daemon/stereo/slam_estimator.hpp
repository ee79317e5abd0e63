// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "host/config/daemon_config.hpp"
#include "host/daemon/stereo/pair_estimator.hpp"
#include "host/vision/enhance/eight_bits.hpp"
#include "host/vision/slam/slam_system.hpp"

namespace pharos::host {

/// Tracks a target without a model from pair to pair (host/vision/slam), with enhanced images if configured. While
/// tracking is lost there is no pose; it relocalises at known views.
class SlamEstimator : public PairEstimator {
 public:
  /// For a rig whose `slam` is set. Throws InputError for an invalid rig or vocabulary.
  explicit SlamEstimator(const StereoConfig& config);
  PairResult measure(const StereoPair& pair) override;
  Ring2Pose no_pose() const override { return SlamPoseEstimate{}; }

 private:
  void begin();
  void add_figures(PairResult& answer);

  RigFile rig_;
  std::string rig_name_;
  double focal_px_;
  slam::SlamSettings settings_;
  enhance::EightBitPairs eight_bits_;
  std::unique_ptr<slam::SlamSystem> system_;
  SpinWindow spin_;
  std::optional<std::int64_t> began_ns_;  // in the pairs' steady time
  bool map_started_ = false;
  std::int64_t maps_ = 0;
  std::int64_t last_figures_ns_ = 0;
};

}  // namespace pharos::host
