// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/standing_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/lottery.hpp"

namespace pharos::tof {
namespace {

// A grid over the frame; every pixel of it that has depth is a sample.
constexpr std::int32_t kColumns = 40;
constexpr std::int32_t kRows = 30;
// Triples lie within a quarter of the frame: where the face is a tenth of the samples, every fiftieth is all on it.
constexpr int kTriples = 300;
constexpr double kNear = 0.25;  // in ray coordinates
constexpr int kTries = 6;       // to find a near one
constexpr std::size_t kLeastOnFace = 20;
// What lies behind a plane speaks against it more than what lies on it speaks for it.
constexpr int kBehind = 4;
constexpr int kRefinements = 2;
// Foil's wrinkles (4 mm) and its own noise: it is a third as bright as what DepthNoise holds for.
constexpr double kWrinkles_m = 0.008;
constexpr double kFoilNoise = 3.0;
constexpr std::uint16_t kFullScale = 65535;

struct Sample {
  Vector2 ray = Vector2::Zero();
  double z_m = 0.0;
};
using Samples = StaticVector<Sample, static_cast<std::size_t>(kColumns* kRows)>;

// How far from a plane a sample of foil still belongs to it.
double gate_m(const DepthNoise& noise, const Sample& s) {
  const double ratio = s.z_m / noise.range_m;
  return kWrinkles_m + kFoilNoise * noise.sigma_m * ratio * ratio;
}
double height_m(const DepthPlane& plane, double size, const Sample& s) {
  return (1.0 - s.z_m * (plane.q.x() * s.ray.x() + plane.q.y() * s.ray.y() + plane.q.z())) / size;
}

// Those behind `front`, where there is one.
void take(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthNoise& noise,
          const DepthPlane* front, Samples& samples) {
  for (std::int32_t row = 0; row < kRows; ++row) {
    const std::int32_t v = (2 * row + 1) * frame.depth.height_px / (2 * kRows);
    for (std::int32_t column = 0; column < kColumns; ++column) {
      const std::int32_t u = (2 * column + 1) * frame.depth.width_px / (2 * kColumns);
      const Sample sample{rays.at(u, v), depth_z_m(camera, frame.depth.at(u, v))};
      if (!has_depth(frame.depth.at(u, v)) || !(sample.z_m > 0.0)) continue;
      if (front != nullptr && height_m(*front, front->q.norm(), sample) > -3.0 * gate_m(noise, sample)) continue;
      samples.push_back(sample);
    }
  }
}

class FaceFinder {
 public:
  FaceFinder(const Samples& samples, const DepthNoise& noise) : samples_(samples), noise_(noise) {}

  std::optional<DepthPlane> find() {
    std::optional<DepthPlane> best;
    int best_score = 0;
    for (int k = 0; k < kTriples; ++k) {
      const auto plane = draw();
      if (!plane) continue;
      const int score = score_of(*plane);
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
    const Sample& first = samples_[lottery_.below(samples_.size())];
    Matrix3 rows;
    Vector3 right;
    for (int i = 0; i < 3; ++i) {
      const Sample* s = &first;
      for (int k = 0; i > 0 && k < kTries; ++k) {
        s = &samples_[lottery_.below(samples_.size())];
        if ((s->ray - first.ray).norm() < kNear) break;
      }
      rows.row(i) << s->ray.x(), s->ray.y(), 1.0;
      right[i] = 1.0 / s->z_m;
    }
    const DepthPlane plane{rows.inverse() * right};
    if (!plane.q.allFinite() || !(plane.q.z() > 0.0)) return std::nullopt;
    return plane;
  }

  // On the plane, less those behind it; 0 where too few are on it.
  int score_of(const DepthPlane& plane) const {
    const double size = plane.q.norm();
    int on_plane = 0;
    int behind = 0;
    for (const Sample& s : samples_) {
      const double over = height_m(plane, size, s);
      on_plane += std::fabs(over) < gate_m(noise_, s) ? 1 : 0;
      behind += over < -3.0 * gate_m(noise_, s) ? 1 : 0;
    }
    return on_plane < static_cast<int>(kLeastOnFace) ? 0 : on_plane - kBehind * behind;
  }

  // Least squares of what lies on it.
  std::optional<DepthPlane> refined(const DepthPlane& plane) const {
    const double size = plane.q.norm();
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    for (const Sample& s : samples_) {
      if (!(std::fabs(height_m(plane, size, s)) < gate_m(noise_, s))) continue;
      const Vector3 row(s.ray.x(), s.ray.y(), 1.0);
      normal.noalias() += row * row.transpose();
      right += row / s.z_m;
    }
    const DepthPlane better{normal.inverse() * right};
    if (!better.q.allFinite() || !(better.q.z() > 0.0)) return std::nullopt;
    return better;
  }

  const Samples& samples_;
  const DepthNoise& noise_;
  Lottery lottery_;
};

}  // namespace

std::optional<DepthPlane> face_plane(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                     const DepthNoise& noise, const DepthPlane* front) {
  Samples samples;
  take(frame, camera, rays, noise, front, samples);
  if (samples.size() < kLeastOnFace) return std::nullopt;
  return FaceFinder(samples, noise).find();
}

void make_standing_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& face,
                         ImageView<std::uint16_t> image) {
  constexpr double kScale = 1.0 / kMostStanding_m;
  for (std::int32_t v = 0; v < frame.depth.height_px; ++v) {
    const std::uint16_t* depth = frame.depth.row(v);
    const std::uint16_t* light = frame.intensity.row(v);
    std::uint16_t* out = image.row(v);
    for (std::int32_t u = 0; u < frame.depth.width_px; ++u) {
      out[u] = 0;
      if (!has_depth(depth[u]) || light[u] == kFullScale) continue;
      const double height = face.height_m(rays.at(u, v), depth_z_m(camera, depth[u]));
      out[u] = static_cast<std::uint16_t>(light[u] * std::clamp(kScale * height, 0.0, 1.0));
    }
  }
}

}  // namespace pharos::tof
