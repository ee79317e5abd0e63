// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "host/vision/slam/feature.hpp"
#include "host/vision/slam/loop_counts.hpp"
#include "host/vision/slam/slam_settings.hpp"
#include "host/vision/slam/spin.hpp"
#include "host/vision/slam/tracked_frame.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::slam {

struct SlamReport {
  int frames = 0, tracked = 0, lost = 0, relocalised = 0, repeated = 0;
  int ambiguous_place = 0;      ///< of the lost ones: a place was recognised and not believed
  int dark = 0, saturated = 0;  ///< frames too dark or too bright for any feature
  Scene scene = Scene::kAuto;   ///< that of the map, or, before it, of the last pair
  int keyframes = 0, keyframes_made = 0, points = 0;
  bool steady_rotation = false;  ///< the last adjustment took the rotation as steady (SlamSettings::steady_rotation)
  int loops = 0, loops_refused = 0;  ///< refused: keyframes of which no candidate closed a loop
  LoopCounts loop_candidates;
  double features_median = 0.0, inliers_median = 0.0;
  double tracking_median_ms = 0.0, tracking_p95_ms = 0.0;
  double mapping_median_ms = 0.0, loop_max_ms = 0.0;  ///< of one keyframe, of one closed loop
};

/// A point of the finished map, in the target's frame, and how many keyframes see it.
struct SlamPoint {
  Vector3 position_m = Vector3::Zero();
  int observers = 0;
};

/// A loop that was closed or, accepted at first, taken back before the map was changed by it; as it was measured.
struct ClosedLoop {
  std::int64_t here = 0, there = 0;                 ///< numbers of the two pairs
  Pose<frame::Camera, frame::Camera> T_here_there;  ///< from the left camera of the one to that of the other
  bool taken_back = false;
};

/// Stereo frames to the pose of a target without a model (paper 004, section 2; ORB-SLAM2 of Mur-Artal 2017).
///
/// After a failure of one of its threads (no memory), push(), finish() and optimised_trajectory() throw
/// std::runtime_error: the map may be inconsistent, and a new system is needed.
class SlamSystem {
 public:
  virtual ~SlamSystem() = default;
  /// A raw pair of the rig's size, 8 bits a pixel; times must grow. Throws InputError for other sizes, where the first
  /// pairs show that left and right are exchanged or of other cameras, and as long as the pairs show a delay between
  /// left and right images (PairSkew).
  virtual TrackedFrame push(double time_s, ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) = 0;
  /// Waits for the threads and adjusts the whole map once more. After it every frame's pose follows from the final map.
  virtual void finish() = 0;
  /// All frames so far, from the present poses of the keyframes; lost ones without a pose.
  virtual std::vector<TrackedFrame> trajectory() const = 0;
  /// The result of trajectory() after finish(), without any effect on the system.
  virtual std::vector<TrackedFrame> optimised_trajectory() const = 0;
  /// Of trajectory(), about an axis in the left camera's frame; after finish() of a steady rotation that one's
  /// (steady_spin).
  virtual std::optional<Spin> spin() const = 0;
  virtual std::vector<SlamPoint> points() const = 0;
  virtual std::vector<ClosedLoop> loops() const = 0;
  virtual SlamReport report() const = 0;
  /// Features of the last pair in the rectified left image: column, row, and 0 (mono), 1 (stereo) or 2 (of the map).
  virtual std::vector<std::array<double, 3>> last_features() const = 0;
  /// The rectified left image of the last pair, and 0 where it was masked.
  virtual ImageView<const std::uint8_t> last_image() const = 0;
  virtual ImageView<const std::uint8_t> last_mask() const = 0;
};

/// Descriptors of an image's ORB features, for training a vocabulary.
std::vector<Descriptor> describe_image(ImageView<const std::uint8_t> image, int features);

/// Throws InputError where the vocabulary or the rig is invalid; `rig_name` is for messages.
std::unique_ptr<SlamSystem> make_slam(const host::RigFile& rig, const std::string& rig_name,
                                      const SlamSettings& settings);

}  // namespace pharos::slam
