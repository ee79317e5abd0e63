// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/vision/slam/frame.hpp"

namespace pharos::slam {

/// Pixels around a stereo feature as a keyframe saw it, and the plane on which they lie: what makes a point of the map
/// one place of the surface, which later frames find again more closely than corners are found.
struct Patch {
  static constexpr int kReach_px = 9;  // to each side, on the feature's level
  static constexpr int kSide_px = 2 * kReach_px + 1;

  KeyframeId keyframe = kNone;
  int level = 0;
  double scale_px = 1.0;            ///< of the level
  Vector2 pixel = Vector2::Zero();  ///< of the feature in the keyframe's image
  double disparity_px = 0.0;
  Vector2 disparity_slope = Vector2::Zero();
  Vector2 off_middle_px = Vector2::Zero();  ///< of the feature from the middle pixel's centre, on the level
  std::array<std::uint8_t, kSide_px * kSide_px> pixels{};
};

/// The patch of a stereo feature; empty for a mono one and where it leaves the image.
std::optional<Patch> cut_patch(KeyframeId keyframe, const Feature& feature, const std::vector<PyramidLevel>& pyramid);

/// A patch is not quite the same thing from another side: its place errs by so much of a pixel of its level even where
/// light is plenty.
inline constexpr double kPatchSigma_px = 0.1;

struct FoundPatch {
  Vector2 pixel = Vector2::Zero();
  double sigma_px = kPatchSigma_px;  ///< of its level: with what the fit's residuals say
};

/// Where the image shows the patch: its pixels as they look from there, fitted by Gauss and Newton over place, contrast
/// and brightness (Baker and Matthews 2004), from the feature's pixel on and on its level. `T_frame_keyframe` need only
/// be good to a degree. Empty where the patch is seen too much aslant, looks otherwise or lies more than a pixel or two
/// off. Some 1.5 us.
std::optional<FoundPatch> find_patch(const Patch& patch, const Pose<frame::Camera, frame::Camera>& T_frame_keyframe,
                                     const StereoCamera& camera, const Feature& feature,
                                     const std::vector<PyramidLevel>& pyramid);

}  // namespace pharos::slam
