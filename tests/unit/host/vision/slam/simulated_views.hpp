// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/pose_only.hpp"

namespace pharos::slam::test {

inline const StereoCamera kCamera{640, 480, 640.0, 640.0, 319.5, 239.5, 0.5};

inline Vector3 random_vector(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> value(-size, size);
  const double x = value(random), y = value(random), z = value(random);
  return {x, y, z};
}

/// Points within a box of 1.6 m.
inline std::vector<Vector3> random_points(std::mt19937_64& random, int count) {
  std::vector<Vector3> points;
  for (int k = 0; k < count; ++k) points.push_back(random_vector(random, 0.8));
  return points;
}

/// The target 5 m ahead, rotated by `turn_rad` about the camera's y axis.
inline CameraFromTarget turned_pose(double turn_rad) {
  return {rotation_exp(Vector3(0.05, turn_rad, 0.02)), Vector3(0.1, -0.05, 5.0)};
}

/// A camera's observation of a point, with noise of `sigma_px` in each coordinate and the corresponding one in the
/// disparity.
inline Observation seen(const Vector3& point, const CameraFromTarget& pose, double sigma_px, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const Vector3 place = kCamera.project(pose * point);
  Observation observation{point, place.head<2>(), place.z(), sigma_px > 0.0 ? sigma_px * sigma_px : 1.0};
  const double across = sigma_px * noise(random);
  observation.pixel.x() += across;
  observation.pixel.y() += sigma_px * noise(random);
  observation.right_u_px += across + kDisparityFraction * sigma_px * noise(random);
  return observation;
}

/// A different descriptor for every point.
inline Descriptor descriptor_of(std::mt19937_64& random) { return {{random(), random(), random(), random()}}; }

/// A frame with all points that are in the image, in their order.
inline Frame frame_of(const std::vector<Vector3>& points, const std::vector<Descriptor>& descriptors,
                      const CameraFromTarget& pose, double sigma_px, std::mt19937_64& random) {
  Frame frame;
  frame.pose = pose;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Observation at = seen(points[k], pose, sigma_px, random);
    Feature feature;
    feature.pixel = at.pixel;
    feature.right_u_px = at.right_u_px;
    feature.depth_m = kCamera.depth_m(at.pixel.x() - at.right_u_px);
    feature.descriptor = descriptors[k];
    frame.features.push_back(feature);
  }
  frame.grid = FeatureGrid(frame.features, kCamera.width_px, kCamera.height_px);
  frame.points.assign(frame.features.size(), kNone);
  return frame;
}

}  // namespace pharos::slam::test
