// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/vision/slam/frame.hpp"

namespace pharos::slam {

/// Pixels around a stereo feature in a keyframe, and the plane of the surface there: they define a map point as one
/// position on the surface, which later frames locate more accurately than a corner.
struct Patch {
  static constexpr int kReach_px = 9;  // to each side, on the feature's level
  static constexpr int kSide_px = 2 * kReach_px + 1;

  KeyframeId keyframe = kNone;
  int level = 0;
  double scale_px = 1.0;            ///< of the level
  Vector2 pixel = Vector2::Zero();  ///< of the feature in the keyframe's image
  double disparity_px = 0.0;
  Vector2 disparity_slope = Vector2::Zero();
  Vector2 off_middle_px = Vector2::Zero();  ///< of the feature from the centre of the central pixel, on the level
  std::array<std::uint8_t, kSide_px * kSide_px> pixels{};
};

/// The patch of a stereo feature; empty for a mono one and where it extends beyond the image.
std::optional<Patch> cut_patch(KeyframeId keyframe, const Feature& feature, const std::vector<PyramidLevel>& pyramid);

/// The appearance of a patch depends on the viewing direction: its position error, px of its level, even without noise.
inline constexpr double kPatchSigma_px = 0.1;

struct FoundPatch {
  Vector2 pixel = Vector2::Zero();
  double sigma_px = kPatchSigma_px;  ///< px of its level, including the part from the fit's residuals
};

/// Position of the patch in the image: its warped pixels are aligned by Gauss-Newton over position, contrast,
/// brightness and brightness' slopes along u and v (Baker and Matthews 2004), starting at the feature's pixel, on its
/// level. The slopes are of light that changes over a turning surface: without them it moves the position.
/// `T_frame_keyframe` need only be accurate to a degree. Empty where the view is too oblique, the appearance differs,
/// or the position moves by more than a pixel or two. Some 2.6 us.
std::optional<FoundPatch> find_patch(const Patch& patch, const Pose<frame::Camera, frame::Camera>& T_frame_keyframe,
                                     const StereoCamera& camera, const Feature& feature,
                                     const std::vector<PyramidLevel>& pyramid);

}  // namespace pharos::slam
