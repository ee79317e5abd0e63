// SPDX-License-Identifier: Apache-2.0
// Section 2.3 of paper 000: the target's frame from ring and connector.
#include "tools/evaluation/reproduce/tof/paper/paper_chain.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace pharos::tools::paper000 {
namespace {

constexpr double kGreys = 255.0;
constexpr int kRingPoints = 8;  // the paper does not say how many; eight reproduce its figures

double middle_depth_m(const sim::TofPixels& pixels, const DepthCamera& camera) {
  std::vector<std::uint16_t> valid;
  std::copy_if(pixels.depth.begin(), pixels.depth.end(), std::back_inserter(valid),
               [](std::uint16_t counts) { return has_depth(counts); });
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

std::optional<Vector3> point_at(const sim::TofPixels& pixels, const DepthCamera& camera, const Vector2& pixel) {
  const auto u = std::lround(pixel.x()), v = std::lround(pixel.y());
  if (u < 0 || v < 0 || u >= pixels.width_px || v >= pixels.height_px) return std::nullopt;
  const std::uint16_t counts = pixels.depth[static_cast<std::size_t>(v * pixels.width_px + u)];
  const auto sight = sight_of(camera, pixel);
  if (!has_depth(counts) || !sight) return std::nullopt;
  return Vector3(depth_z_m(camera, counts) * *sight);
}

// q . p = 1 for the points of the ring's plane.
std::optional<Vector3> plane_of(const sim::TofPixels& pixels, const DepthCamera& camera, const PaperEllipse& ring) {
  Matrix3 squares = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  const double c = std::cos(ring.theta_rad), s = std::sin(ring.theta_rad);
  for (int i = 0; i < kRingPoints; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kRingPoints;
    const double along = ring.a_px * std::cos(turn), across = ring.b_px * std::sin(turn);
    const auto point =
        point_at(pixels, camera, {ring.cx_px + c * along - s * across, ring.cy_px + s * along + c * across});
    if (!point) return std::nullopt;
    squares += *point * point->transpose();
    right += *point;
  }
  return Vector3(squares.ldlt().solve(right));
}

const Region* nearest(const std::vector<Region>& regions, const PaperEllipse& ring) {
  const Vector2 centre(ring.cx_px, ring.cy_px);
  const auto best = std::min_element(regions.begin(), regions.end(), [&](const Region& a, const Region& b) {
    return (a.middle_px - centre).norm() < (b.middle_px - centre).norm();
  });
  return best == regions.end() ? nullptr : &*best;
}

}  // namespace

ChainStages grey_of(const sim::TofPixels& pixels, const DepthCamera& camera, double span_m) {
  ChainStages stages;
  stages.width_px = pixels.width_px;
  stages.height_px = pixels.height_px;
  const double far_m = middle_depth_m(pixels, camera) + 0.5 * span_m;
  for (const std::uint16_t counts : pixels.depth) {
    const double grey = has_depth(counts) ? (far_m - counts * camera.depth_scale_m) / span_m * kGreys : 0.0;
    stages.grey.push_back(static_cast<std::uint8_t>(std::clamp(std::round(grey), 0.0, kGreys)));
  }
  return stages;
}

ChainResult measure(const sim::TofPixels& eight_bit, const DepthCamera& camera, const ChainSettings& settings) try {
  constexpr double kSpan_m = 1.0;  // of the 256 grey values: one is 3.9 mm, "some millimetres"
  ChainResult result;
  result.stages = grey_of(eight_bit, camera, kSpan_m);
  find_ring(result.stages);
  if (!result.stages.ring) {
    result.why = "no two ellipses of a ring";
    return result;
  }
  find_connectors(result.stages, settings);
  const PaperEllipse ring = mean_of((*result.stages.ring)[0], (*result.stages.ring)[1]);
  const Region* connector = nearest(result.stages.regions[3], ring);
  if (connector == nullptr) {
    result.why = "no connector";
    return result;
  }
  const auto plane = plane_of(eight_bit, camera, ring);
  const auto sight = sight_of(camera, {ring.cx_px, ring.cy_px});
  const auto middle = point_at(eight_bit, camera, connector->middle_px);
  if (!plane || !sight || !middle) {
    result.why = "no depth at a point of the ring or the connector";
    return result;
  }
  Pose<frame::Camera, frame::Target> pose;
  pose.t = *sight / plane->dot(*sight);
  const Vector3 z = -plane->normalized();
  const Vector3 y = z.cross(*middle - pose.t).normalized();
  pose.R << y.cross(z), y, z;
  if (pose.is_finite()) result.pose = pose;
  return result;
} catch (const cv::Exception& error) {
  ChainResult failed;
  failed.why = std::string("OpenCV: ") + error.what();
  return failed;
}

}  // namespace pharos::tools::paper000
