// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/patch_alignment.hpp"

namespace pharos::slam {

void align_with_patches(Frame& frame, const Map& map, const StereoCamera& camera, const CameraFromTarget& pose,
                        const std::vector<PyramidLevel>& pyramid) {
  if (pyramid.empty()) return;
  KeyframeId of = kNone;
  Pose<frame::Camera, frame::Camera> T_frame_keyframe;
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    const MapPoint* point = map.find_point(frame.points[k]);
    if (point == nullptr || !point->patch) continue;
    if (point->patch->keyframe != of) {
      of = point->patch->keyframe;
      T_frame_keyframe = pose * map.pose_of(of).inverse();
    }
    Feature& feature = frame.features[k];
    const auto found = find_patch(*point->patch, T_frame_keyframe, camera, feature, pyramid);
    if (!found) continue;
    const Vector2 move = found->pixel - feature.pixel;
    feature.pixel = found->pixel;
    feature.sigma_px = found->sigma_px;
    if (!feature.stereo()) continue;
    feature.right_u_px += move.x() - feature.disparity_slope.dot(move);
    feature.depth_m = camera.depth_m(feature.pixel.x() - feature.right_u_px);
  }
}

PoseOnly place_frame(Frame& frame, const Map& map, const StereoCamera& camera, const CameraFromTarget& start) {
  std::vector<Observation> observations;
  std::vector<std::size_t> features;
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    const MapPoint* point = map.find_point(frame.points[k]);
    if (point == nullptr) continue;
    observations.push_back(observation_of(frame.features[k], point->position_m));
    features.push_back(k);
  }
  PoseOnly placed = adjust_pose(observations, camera, start);
  std::vector<Observation> aligned;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (frame.features[features[k]].sigma_px < kCornerSigma_px) aligned.push_back(observations[k]);
  }
  frame.variance_factor = variance_factor(aligned, camera, placed.pose);
  placed.covariance *= frame.variance_factor * correlation_factor(observations, camera, placed);
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (!placed.inlier[k]) frame.points[features[k]] = kNone;
  }
  return placed;
}

}  // namespace pharos::slam
