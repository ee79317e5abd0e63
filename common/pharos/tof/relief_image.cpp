// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/relief_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/tof/constants.hpp"
#include "pharos/tof/ransac_sampler.hpp"

namespace pharos::tof {
namespace {

// A grid over the frame; every pixel of it that has depth is a sample.
constexpr std::int32_t kColumns = 40;
constexpr std::int32_t kRows = 30;
// Triples lie within a quarter of the frame: where the face is a tenth of the samples, every fiftieth is all on it.
constexpr int kTriples = 300;
constexpr double kNear = 0.25;  // in ray coordinates
constexpr int kTries = 6;       // to find a near one
constexpr std::size_t kMinOnFace = 20;
// A sample behind a plane counts against it more than one on it counts for it.
constexpr int kBehind = 4;
constexpr int kRefinements = 2;
// Foil's wrinkles (4 mm) and its own noise: it is a third as bright as DepthNoise assumes.
constexpr double kWrinkles_m = 0.008;
constexpr double kFoilNoise = 3.0;

// Columns, so that compilers take two at a time.
struct ReliefSamples {
  using Column = std::array<double, static_cast<std::size_t>(kColumns* kRows)>;
  Column ray_x, ray_y, z_m;
  Column gate_m;  // distance from a plane within which a sample of foil belongs to it
  std::size_t count = 0;

  void add(const Vector2& ray, double z, double gate) {
    ray_x[count] = ray.x();
    ray_y[count] = ray.y();
    z_m[count] = z;
    gate_m[count++] = gate;
  }
  Vector2 ray(std::size_t k) const { return {ray_x[k], ray_y[k]}; }
};

double gate_of(const DepthNoise& noise, double z_m) {
  const double ratio = z_m / noise.range_m;
  return kWrinkles_m + kFoilNoise * noise.sigma_m * ratio * ratio;
}

// Those behind `front`, where there is one.
void take(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthNoise& noise,
          const DepthPlane* front, ReliefSamples& samples) {
  for (std::int32_t row = 0; row < kRows; ++row) {
    const std::int32_t v = (2 * row + 1) * frame.depth.height_px / (2 * kRows);
    for (std::int32_t column = 0; column < kColumns; ++column) {
      const std::int32_t u = (2 * column + 1) * frame.depth.width_px / (2 * kColumns);
      const Vector2 ray = rays.at(u, v);
      const double z_m = depth_z_m(camera, frame.depth.at(u, v)), gate_m = gate_of(noise, z_m);
      if (!has_depth(frame.depth.at(u, v)) || !(z_m > 0.0)) continue;
      if (front != nullptr && front->height_m(ray, z_m) > -3.0 * gate_m) continue;
      samples.add(ray, z_m, gate_m);
    }
  }
}

class FaceFinder {
 public:
  explicit FaceFinder(const ReliefSamples& samples) : samples_(samples) {}

  std::optional<DepthPlane> find() {
    std::optional<DepthPlane> best;
    int best_score = 0;
    for (int k = 0; k < kTriples; ++k) {
      const auto plane = draw();
      if (!plane) continue;
      const int score = score_of(*plane, best_score);
      if (score <= best_score) continue;
      best = plane;
      best_score = score;
    }
    for (int k = 0; best && k < kRefinements; ++k) best = refined(*best);
    return best;
  }

 private:
  // One sample and two near it.
  std::optional<DepthPlane> draw() {
    const std::size_t first = ransac_sampler_.below(samples_.count);
    Matrix3 rows;
    Vector3 right;
    for (int i = 0; i < 3; ++i) {
      std::size_t s = first;
      for (int k = 0; i > 0 && k < kTries; ++k) {
        s = ransac_sampler_.below(samples_.count);
        if ((samples_.ray(s) - samples_.ray(first)).norm() < kNear) break;
      }
      rows.row(i) << samples_.ray_x[s], samples_.ray_y[s], 1.0;
      right[i] = 1.0 / samples_.z_m[s];
    }
    const DepthPlane plane{rows.inverse() * right};
    if (!plane.q.allFinite() || !(plane.q.z() > 0.0)) return std::nullopt;
    return plane;
  }

  // On the plane, less those behind it; 0 where too few are on it. Stops where it can no longer exceed `most`.
  int score_of(const DepthPlane& plane, int maximum) const {
    constexpr std::size_t kTogether = 128;
    const double size = plane.q.norm(), qx = plane.q.x(), qy = plane.q.y(), qz = plane.q.z();
    std::array<double, kTogether> over;
    int on_plane = 0;
    int behind = 0;
    for (std::size_t begin = 0; begin < samples_.count; begin += kTogether) {
      const std::size_t end = std::min(samples_.count, begin + kTogether);
      for (std::size_t k = begin; k < end; ++k) {
        over[k - begin] = (1.0 - samples_.z_m[k] * (qx * samples_.ray_x[k] + qy * samples_.ray_y[k] + qz)) / size;
      }
      for (std::size_t k = begin; k < end; ++k) {
        on_plane += std::fabs(over[k - begin]) < samples_.gate_m[k] ? 1 : 0;
        behind += over[k - begin] < -3.0 * samples_.gate_m[k] ? 1 : 0;
      }
      if (on_plane + static_cast<int>(samples_.count - end) - kBehind * behind <= maximum) return 0;
    }
    return on_plane < static_cast<int>(kMinOnFace) ? 0 : on_plane - kBehind * behind;
  }

  // Least squares of the samples on it.
  std::optional<DepthPlane> refined(const DepthPlane& plane) const {
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    for (std::size_t k = 0; k < samples_.count; ++k) {
      const Vector2 ray = samples_.ray(k);
      if (!(std::fabs(plane.height_m(ray, samples_.z_m[k])) < samples_.gate_m[k])) continue;
      const Vector3 row(ray.x(), ray.y(), 1.0);
      normal.noalias() += row * row.transpose();
      right += row / samples_.z_m[k];
    }
    const DepthPlane better{normal.inverse() * right};
    if (!better.q.allFinite() || !(better.q.z() > 0.0)) return std::nullopt;
    return better;
  }

  const ReliefSamples& samples_;
  RansacSampler ransac_sampler_;
};

}  // namespace

std::optional<DepthPlane> face_plane(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                     const DepthNoise& noise, const DepthPlane* front) {
  ReliefSamples samples;
  take(frame, camera, rays, noise, front, samples);
  if (samples.count < kMinOnFace) return std::nullopt;
  return FaceFinder(samples).find();
}

void make_relief_image(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& face,
                       ImageView<std::uint16_t> image) {
  constexpr double kScale = 1.0 / kMaxStanding_m;
  const double size = face.q.norm(), qx = face.q.x(), qy = face.q.y(), qz = face.q.z();
  const double scale = camera.depth_scale_m, origin = camera.depth_origin_z_m;
  RayGrid::Row<double> ray;
  for (std::int32_t v = 0; v < frame.depth.height_px; ++v) {
    const std::uint16_t* depth = frame.depth.row(v);
    const std::uint16_t* light = frame.intensity.row(v);
    std::uint16_t* out = image.row(v);
    rays.row_at(0, v, frame.depth.width_px, ray);
    const double *x = ray.x(), *y = ray.y();
    for (std::int32_t u = 0; u < frame.depth.width_px; ++u) {
      const double height = (1.0 - (depth[u] * scale + origin) * (qx * x[u] + qy * y[u] + qz)) / size;
      const auto fraction = static_cast<std::int32_t>(light[u] * std::clamp(kScale * height, 0.0, 1.0));
      out[u] = static_cast<std::uint16_t>(has_depth(depth[u]) && light[u] != kFullScale ? fraction : 0);
    }
  }
}

}  // namespace pharos::tof
