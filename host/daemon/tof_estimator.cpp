// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/tof_estimator.hpp"

#include "host/preview/tof_drawing.hpp"
#include "host/runtime/now.hpp"
#include "host/support/flag_text.hpp"
#include "pharos/tof/tof_pose.hpp"

namespace pharos::host {
namespace {

// Measures the time between the ends of consecutive stages.
class StageClock final : public tof::TofStageListener {
 public:
  explicit StageClock(std::array<std::int64_t, tof::kTofStages>& stage_ns) : stage_ns_(stage_ns) {}

  void ended(tof::TofStage stage) override {
    const std::int64_t now_ns = monotonic_now_ns();
    stage_ns_[static_cast<std::size_t>(stage)] += now_ns - last_ns_;
    last_ns_ = now_ns;
  }

 private:
  std::array<std::int64_t, tof::kTofStages>& stage_ns_;
  std::int64_t last_ns_ = monotonic_now_ns();
};

}  // namespace

TofEstimator::TofEstimator(const DepthCamera& camera, const tof::TofSettings& settings)
    : camera_(camera), settings_(settings), workspace_(std::make_unique<tof::TofWorkspace>()) {}

TofEstimator::~TofEstimator() = default;

DepthCamera camera_of(const DepthFrame& frame, const DepthCamera& by_file) {
  DepthCamera camera = by_file;
  if (!frame.scale) return camera;
  constexpr std::size_t kZ = 2;
  camera.scale_m = frame.scale->scale_m;
  camera.offset_m = frame.scale->offset_m;
  camera.depth_scale_m = frame.scale->scale_m[kZ];
  camera.depth_origin_z_m += frame.scale->offset_m[kZ];
  return camera;
}

TofResult TofEstimator::measure(const DepthFrame& frame) {
  TofResult answer;
  StageClock clock(answer.stage_ns);
  auto pose = tof::measure_tof_pose({frame.intensity_view(), frame.depth_view()}, camera_of(frame, camera_), settings_,
                                    *workspace_, &clock);
  if (pose) pair_.refine(*pose);
  last_ = pose ? std::make_unique<tof::TofPose>(*pose) : nullptr;
  if (!pose) {
    answer.refusal = tof::name_of(pose.error());
    answer.advice = tof::describe(pose.error());
    return answer;
  }
  answer.flags = joined_flags(pose->flags, tof::kTofFlagWords);
  answer.observations = pose->ring.fit.edge_points + pose->ring.fit.plane_pixels;
  answer.estimate.pose = pose->target.pose;
  answer.estimate.covariance = pose->target.covariance;
  answer.estimate.observations = answer.observations;
  // Two connectors are equally near, and neither fits the frame worse.
  if (pose->second) answer.estimate.second = {pose->second->pose, pose->delta_chi2};
  return answer;
}

Drawing TofEstimator::drawing() const {
  return last_ ? tof_drawing(*last_, camera_) : ellipses_drawing(workspace_->ellipse);
}

}  // namespace pharos::host
