// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "host/vision/slam/foreground.hpp"
#include "host/vision/slam/orb_extractor.hpp"
#include "host/vision/slam/rectification.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "host/vision/slam/stereo_match.hpp"

namespace pharos::slam {

/// From a raw pair to stereo features of the rectified left image: rectification, foreground, ORB, match along rows.
class StereoFrontend {
 public:
  StereoFrontend(Rectification rectification, const SlamSettings& settings);
  ~StereoFrontend();

  struct Result {
    std::vector<Feature> features;
    StereoMatchStats stats;
    bool dark = false;       ///< hardly a pixel above the noise
    bool saturated = false;  ///< hardly a pixel below the limit
    bool repeated = false;   ///< both images equal the pair before, pixel by pixel
  };
  /// `check_order`: see match_stereo().
  Result push(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, bool check_order);

  /// The scene of the last pair: the one that was set, or (Scene::kAuto) the one that its left image shows.
  Scene scene() const { return settings_.scene == Scene::kAuto ? seen_scene_ : settings_.scene; }
  /// The scene is known: later pairs are of this one.
  void keep_scene() { settings_.scene = scene(); }

  const StereoCamera& camera() const { return rectification_.camera; }
  const Matrix3& R_left_rectified() const { return rectification_.R_left_rectified; }
  ImageView<const std::uint8_t> image() const;
  ImageView<const std::uint8_t> mask() const;
  /// Of the left image.
  const std::vector<PyramidLevel>& pyramid() const;

 private:
  struct Work;
  Rectification rectification_;
  SlamSettings settings_;
  Scene seen_scene_ = Scene::kTarget;
  std::unique_ptr<Work> work_;
};

}  // namespace pharos::slam
