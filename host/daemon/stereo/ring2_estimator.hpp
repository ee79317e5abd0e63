// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/cameras/rig_file.hpp"
#include "host/daemon/stereo/pair_estimator.hpp"
#include "host/vision/ring2/ring2_detector.hpp"

namespace pharos::host {

/// Detects docking ring and nozzle in each pair separately (host/vision/ring2).
class Ring2Estimator : public PairEstimator {
 public:
  /// Throws InputError for an invalid rig.
  explicit Ring2Estimator(const RigFile& rig);
  PairResult measure(const StereoPair& pair) override;
  Ring2Pose no_pose() const override { return Ring2PoseEstimate{}; }

 private:
  Ring2Detector finder_;
  double focal_px_;
};

}  // namespace pharos::host
