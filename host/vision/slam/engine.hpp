// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>

#include "host/vision/slam/final_adjustment.hpp"
#include "host/vision/slam/keyframe_worker.hpp"
#include "host/vision/slam/loop_closing.hpp"
#include "host/vision/slam/pair_order.hpp"
#include "host/vision/slam/pair_skew.hpp"
#include "host/vision/slam/pyramid_copy.hpp"
#include "host/vision/slam/run_figures.hpp"
#include "host/vision/slam/tracker.hpp"
#include "host/vision/slam/trajectory_log.hpp"

namespace pharos::slam {

/// Implementation of SlamSystem: tracking in the caller's thread, mapping and loop closing after it or in their own
/// threads.
///
/// One mutex protects map, tracker and recognition; adjustments work on copies without holding it.
class Engine final : public SlamSystem {
 public:
  /// Called with each keyframe when its mapping begins, in the mapping thread.
  using KeyframeCallback = std::function<void(KeyframeId)>;

  Engine(Rectification rectification, Vocabulary vocabulary, const SlamSettings& settings,
         KeyframeCallback on_keyframe = {});

  TrackedFrame push(double time_s, ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) override;
  void finish() override;
  std::vector<TrackedFrame> trajectory() const override;
  std::vector<TrackedFrame> optimised_trajectory() const override;
  std::optional<Spin> spin() const override;
  std::vector<SlamPoint> points() const override;
  std::vector<ClosedLoop> loops() const override;
  SlamReport report() const override;
  std::vector<std::array<double, 3>> last_features() const override;
  ImageView<const std::uint8_t> last_image() const override { return frontend_.image(); }
  ImageView<const std::uint8_t> last_mask() const override { return frontend_.mask(); }

 private:
  void check_threads() const;
  void wait_for_threads() const;
  FinalAdjustment adjust_map(Map& map) const;
  std::optional<Spin> spin_of(const FinalAdjustment& solution) const;
  TrackedPose pose_of(const Tracked& tracked) const;
  TrackedFrame place(Frame& frame, const StereoFrontend::Result& seen, KeyframeId& made);
  KeyframeId make_keyframe(Frame& frame);
  PyramidCopy take_image(KeyframeId id);
  void note_skew(const Frame& frame);
  void map_keyframe(KeyframeId id);
  void close_loop(KeyframeId id);
  ClosedLoop in_left_camera(const Loop& loop) const;

  SlamSettings settings_;
  StereoFrontend frontend_;
  mutable std::mutex mutex_;
  Map map_;
  KeyframeDatabase keyframe_database_;
  Tracker tracker_;
  LoopCloser closer_;
  std::vector<ClosedLoop> loops_;
  std::int64_t corrections_ = 0;  // of the whole map
  TrajectoryLog log_;
  Frame last_;
  std::vector<PointId> recent_;
  std::map<KeyframeId, PyramidCopy> kept_;  // images of keyframes that loop closing has not seen yet
  double last_keyframe_s_ = 0.0;
  // Of the last adjustment, until the next pair.
  std::optional<SteadyRotation> steady_;
  std::optional<Spin> steady_spin_;
  PairOrder order_;
  PairSkew skew_;

  RunFigures figures_;

  KeyframeCallback on_keyframe_;
  // Last members, because they use all the others; mapping ends first, because it passes keyframes to loop closing.
  // Empty without threads.
  std::optional<KeyframeWorker> closing_, mapping_;
};

}  // namespace pharos::slam
