// SPDX-License-Identifier: Apache-2.0
// Section 2.3 of paper 000: the target's frame from ring and connector.
#include "tools/tof/paper/paper_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <utility>

#include "pharos/geometry/symmetric.hpp"

namespace pharos::tools::paper000 {
namespace {

constexpr double kGreys = 255.0;
constexpr int kRingPoints = 8;  // the paper does not say how many; eight reproduce its figures

constexpr double kSpan_m = 1.0;  // of the 256 grey values

template <class Visit>
void for_each(DepthView depth, Visit&& visit) {
  for (std::int32_t v = 0; v < depth.height_px; ++v) {
    for (std::int32_t u = 0; u < depth.width_px; ++u) visit(depth.at(u, v));
  }
}

double middle_depth_m(DepthView depth, const DepthCamera& camera) {
  std::vector<std::uint16_t> valid;
  for_each(depth, [&](std::uint16_t counts) {
    if (has_depth(counts)) valid.push_back(counts);
  });
  if (valid.empty()) return 0.0;
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return *middle * camera.depth_scale_m;
}

PaperEllipse mean_of(const PaperEllipse& one, const PaperEllipse& other) {
  PaperEllipse mean = one;
  mean.cx_px = 0.5 * (one.cx_px + other.cx_px);
  mean.cy_px = 0.5 * (one.cy_px + other.cy_px);
  mean.a_px = 0.5 * (one.a_px + other.a_px);
  mean.b_px = 0.5 * (one.b_px + other.b_px);
  mean.theta_rad += 0.5 * std::remainder(other.theta_rad - one.theta_rad, std::numbers::pi);
  return mean;
}

std::optional<Vector3> sight_of(const DepthCamera& camera, const Vector2& pixel) {
  const Result<Vector2, CameraFailure> ray = undistort(camera.intrinsics, pixel);
  if (!ray) return std::nullopt;
  return Vector3(ray->x(), ray->y(), 1.0);
}

std::optional<Vector3> point_at(DepthView depth, const DepthCamera& camera, const Vector2& pixel) {
  const auto u = static_cast<std::int32_t>(std::lround(pixel.x())),
             v = static_cast<std::int32_t>(std::lround(pixel.y()));
  if (!depth.contains(u, v)) return std::nullopt;
  const std::uint16_t counts = depth.at(u, v);
  const auto sight = sight_of(camera, pixel);
  if (!has_depth(counts) || !sight) return std::nullopt;
  return Vector3(depth_z_m(camera, counts) * *sight);
}

// q . p = 1 for the points of the ring's plane.
std::optional<Vector3> plane_of(DepthView depth, const DepthCamera& camera, const PaperEllipse& ring) {
  Matrix3 squares = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  const double c = std::cos(ring.theta_rad), s = std::sin(ring.theta_rad);
  for (int i = 0; i < kRingPoints; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kRingPoints;
    const double along = ring.a_px * std::cos(turn), across = ring.b_px * std::sin(turn);
    const auto point =
        point_at(depth, camera, {ring.cx_px + c * along - s * across, ring.cy_px + s * along + c * across});
    if (!point) return std::nullopt;
    squares += *point * point->transpose();
    right += *point;
  }
  return solve_symmetric<3>(squares, right);
}

const Region* nearest(const std::vector<Region>& regions, const PaperEllipse& ring) {
  const Vector2 centre(ring.cx_px, ring.cy_px);
  const auto best = std::min_element(regions.begin(), regions.end(), [&](const Region& a, const Region& b) {
    return (a.middle_px - centre).norm() < (b.middle_px - centre).norm();
  });
  return best == regions.end() ? nullptr : &*best;
}

// The depths in 256 grey values, near is bright; 0 where there is none.
ChainStages grey_of(DepthView depth, const DepthCamera& camera) {
  ChainStages stages;
  stages.width_px = depth.width_px;
  stages.height_px = depth.height_px;
  const double far_m = middle_depth_m(depth, camera) + 0.5 * kSpan_m;
  for_each(depth, [&](std::uint16_t counts) {
    const double grey = has_depth(counts) ? (far_m - counts * camera.depth_scale_m) / kSpan_m * kGreys : 0.0;
    stages.grey.push_back(static_cast<std::uint8_t>(std::clamp(std::round(grey), 0.0, kGreys)));
  });
  return stages;
}

ChainResult failed(ChainResult result, ChainFailure failure) {
  result.failure = failure;
  return result;
}

}  // namespace

std::string_view name_of(ChainFailure failure) {
  switch (failure) {
    case ChainFailure::kNoRing:
      return "no_ring";
    case ChainFailure::kNoConnector:
      return "no_connector";
    case ChainFailure::kNoDepth:
      return "no_depth";
    case ChainFailure::kNoPlane:
      return "no_plane";
    case ChainFailure::kUnusable:
      break;
  }
  return "unusable";
}

std::vector<std::uint16_t> eight_bit_depth(DepthView depth, const DepthCamera& camera) {
  constexpr double kMiddleStep_m = 0.1;
  const double middle_m = std::round(middle_depth_m(depth, camera) / kMiddleStep_m) * kMiddleStep_m;
  const double low_m = middle_m - 0.5 * kSpan_m;
  std::vector<std::uint16_t> rounded;
  for_each(depth, [&](std::uint16_t counts) {
    const double grey = std::round((counts * camera.depth_scale_m - low_m) / kSpan_m * kGreys);
    const bool inside = has_depth(counts) && grey >= 0.0 && grey <= kGreys;
    rounded.push_back(
        inside ? static_cast<std::uint16_t>(std::lround((low_m + grey / kGreys * kSpan_m) / camera.depth_scale_m))
               : kNoDepthLow);
  });
  return rounded;
}

Result<Pose<frame::Camera, frame::Target>, ChainFailure> pose_from(DepthView depth, const DepthCamera& camera,
                                                                   const std::array<PaperEllipse, 2>& ring,
                                                                   const Vector2& connector_px) {
  const PaperEllipse mean = mean_of(ring[0], ring[1]);
  const auto plane = plane_of(depth, camera, mean);
  const auto sight = sight_of(camera, {mean.cx_px, mean.cy_px});
  const auto middle = point_at(depth, camera, connector_px);
  if (!plane || !sight || !middle) return ChainFailure::kNoDepth;
  Pose<frame::Camera, frame::Target> pose;
  pose.t = *sight / plane->dot(*sight);
  const Vector3 z = -plane->normalized();
  const Vector3 y = z.cross(*middle - pose.t).normalized();
  pose.R << y.cross(z), y, z;
  if (!pose.is_finite() || pose.t.z() <= 0.0) return ChainFailure::kNoPlane;
  return pose;
}

ChainResult measure(DepthView depth, const DepthCamera& camera, const ChainSettings& settings) try {
  ChainResult result;
  result.stages = grey_of(depth, camera);
  find_ring(result.stages);
  if (!result.stages.ring) return failed(std::move(result), ChainFailure::kNoRing);
  find_connectors(result.stages, settings);
  const auto& ring = *result.stages.ring;
  const Region* connector = nearest(result.stages.regions[3], mean_of(ring[0], ring[1]));
  if (connector == nullptr) return failed(std::move(result), ChainFailure::kNoConnector);
  result.connector_px = connector->middle_px;
  const auto pose = pose_from(depth, camera, ring, *result.connector_px);
  if (!pose) return failed(std::move(result), pose.error());
  result.pose = *pose;
  return result;
} catch (const cv::Exception&) {
  return failed({}, ChainFailure::kUnusable);
}

}  // namespace pharos::tools::paper000
