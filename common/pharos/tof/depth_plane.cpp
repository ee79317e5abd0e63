// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/depth_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/lottery.hpp"
#include "pharos/tof/sector_sums.hpp"

namespace pharos::tof {
namespace {

// Pixels that the start is chosen among, and triples tried: with 55 % good pixels all triples are bad once in 50,000.
constexpr std::int32_t kStartPixels = 300;
constexpr int kTriples = 64;
// Deviations within which a pixel belongs to the plane.
constexpr double kGate = 3.0;
// Median of |normal| over its deviation.
constexpr double kMedianToSigma = 1.4826;
constexpr int kPasses = 3;
// Amplitude's weight stays within this factor of the median's, so that a glint does not decide.
constexpr double kMostWeight = 4.0;

struct Sample {
  Vector2 ray = Vector2::Zero();
  double inverse_z = 0.0;
};
using Samples = StaticVector<Sample, kStartPixels>;

double residual(const Vector3& q, const Sample& s) {
  return s.inverse_z - (q.x() * s.ray.x() + q.y() * s.ray.y() + q.z());
}

// What a pass sums: normal equations of 1/z = q . r, and the residuals about the q that came in.
struct Sums {
  Matrix3 normal = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  double weights = 0.0;
  SectorSums residuals;
};

class Fitter {
 public:
  Fitter(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingRegion& region)
      : frame_(frame), camera_(camera), rays_(rays), region_(region) {}

  std::optional<PlaneFit> fit() {
    count();
    if (with_depth_ < kLeastPlanePixels) return std::nullopt;
    take_start_pixels();
    Vector3 q;
    double sigma = start(q);
    if (!(sigma > 0.0)) return std::nullopt;
    Sums sums;
    for (int pass = 0; pass < kPasses; ++pass) {
      sums = summed(q, kGate * sigma);
      if (sums.residuals.count() < kLeastPlanePixels) return std::nullopt;
      const Vector3 next = sums.normal.inverse() * sums.right;
      if (!next.allFinite()) return std::nullopt;
      q = next;
      sigma = std::max(floor_, kGateLoss * std::sqrt(sums.residuals.variance()));
    }
    if (!(q.z() > 0.0)) return std::nullopt;
    return answer(q, sigma);
  }

 private:
  // A normal distribution cut at kGate has this much less deviation than the whole.
  static constexpr double kGateLoss = 1.0 / 0.98657;

  template <class Visit>
  void for_each_depth(Visit visit) const {
    for_each_pixel_between(region_.inner, region_.outer, frame_.depth.width_px, frame_.depth.height_px,
                           [&](std::int32_t u, std::int32_t v) {
                             const std::uint16_t counts = frame_.depth.at(u, v);
                             if (has_depth(counts)) visit(u, v, counts);
                           });
  }
  Sample sample(std::int32_t u, std::int32_t v, std::uint16_t counts) const {
    return {rays_.at(u, v), 1.0 / depth_z_m(camera_, counts)};
  }

  void count() {
    for_each_pixel_between(region_.inner, region_.outer, frame_.depth.width_px, frame_.depth.height_px,
                           [&](std::int32_t u, std::int32_t v) {
                             ++pixels_;
                             with_depth_ += has_depth(frame_.depth.at(u, v)) ? 1 : 0;
                           });
  }

  // Evenly over the region; their median amplitude is what weights are relative to.
  void take_start_pixels() {
    std::int32_t index = 0;
    std::array<std::uint16_t, kStartPixels> amplitudes{};
    for_each_depth([&](std::int32_t u, std::int32_t v, std::uint16_t counts) {
      const bool take = static_cast<std::int64_t>(index) * kStartPixels / with_depth_ !=
                        (static_cast<std::int64_t>(index) + 1) * kStartPixels / with_depth_;
      ++index;
      if (!take || !(depth_z_m(camera_, counts) > 0.0) || start_.full()) return;
      amplitudes[start_.size()] = frame_.intensity.at(u, v);
      start_.push_back(sample(u, v, counts));
    });
    const auto middle = amplitudes.begin() + static_cast<std::ptrdiff_t>(start_.size() / 2);
    std::nth_element(amplitudes.begin(), middle, amplitudes.begin() + static_cast<std::ptrdiff_t>(start_.size()));
    amplitude_ = std::max<double>(1.0, *middle);
    weight_scale_ = 1.0 / (amplitude_ * amplitude_);
    // Noiseless depths still differ by their rounding.
    floor_ = start_.empty() ? 0.0 : camera_.depth_scale_m * start_[0].inverse_z * start_[0].inverse_z;
  }

  // Least median of squares; the deviation that goes with it, 1/m.
  double start(Vector3& best) const {
    const std::size_t count = start_.size();
    if (count < kLeastPlanePixels / 2) return 0.0;
    Lottery lottery;
    double best_median = -1.0;
    std::array<double, kStartPixels> distance{};
    for (int k = 0; k < kTriples; ++k) {
      const Sample* three[3] = {&start_[lottery.below(count)], &start_[lottery.below(count)],
                                &start_[lottery.below(count)]};
      Matrix3 rows;
      Vector3 right;
      for (int i = 0; i < 3; ++i) {
        rows.row(i) << three[i]->ray.x(), three[i]->ray.y(), 1.0;
        right[i] = three[i]->inverse_z;
      }
      const Vector3 q = rows.inverse() * right;
      if (!q.allFinite()) continue;
      std::size_t nearer = 0;
      for (std::size_t i = 0; i < count; ++i) {
        distance[i] = std::fabs(residual(q, start_[i]));
        nearer += distance[i] < best_median ? 1U : 0U;
      }
      if (best_median >= 0.0 && nearer <= count / 2) continue;  // the median is no less
      const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(count / 2);
      std::nth_element(distance.begin(), middle, distance.begin() + static_cast<std::ptrdiff_t>(count));
      best_median = *middle;
      best = q;
    }
    return best_median < 0.0 ? 0.0 : std::max(kMedianToSigma * best_median, floor_);
  }

  double weight(std::int32_t u, std::int32_t v) const {
    const double amplitude = frame_.intensity.at(u, v);
    return std::clamp(amplitude * amplitude * weight_scale_, 1.0 / kMostWeight, kMostWeight);
  }

  Sums summed(const Vector3& q, double gate) const {
    Sums sums;
    for_each_depth([&](std::int32_t u, std::int32_t v, std::uint16_t counts) {
      const Sample s = sample(u, v, counts);
      const double r = residual(q, s);
      const double w = weight(u, v);
      if (!(r * r * w < gate * gate)) return;
      const Vector3 row(s.ray.x(), s.ray.y(), 1.0);
      sums.normal.noalias() += (w * row) * row.transpose();
      sums.right += (w * s.inverse_z) * row;
      sums.weights += w;
      sums.residuals.add(u - middle_u(), v - middle_v(), w, r);
    });
    return sums;
  }
  double middle_u() const { return 0.5 * (region_.outer.left_px() + region_.outer.right_px()); }
  double middle_v() const { return 0.5 * (region_.outer.top_px() + region_.outer.bottom_px()); }

  std::optional<PlaneFit> answer(const Vector3& q, double sigma) const {
    const Sums sums = summed(q, kGate * sigma);
    const std::int32_t used = sums.residuals.count();
    if (used < kLeastPlanePixels) return std::nullopt;
    PlaneFit fit;
    fit.plane.q = q;
    fit.pixels = used;
    fit.amplitude = amplitude_;
    fit.inlier_share = static_cast<double>(used) / pixels_;
    const double mean_inverse_z = sums.right.z() / sums.weights;
    fit.rms_m = sigma / (mean_inverse_z * mean_inverse_z);
    fit.correlation = sums.residuals.correlation(3);
    fit.information = sums.normal / (sigma * sigma * fit.correlation);
    return fit;
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingRegion& region_;
  std::int32_t pixels_ = 0;
  std::int32_t with_depth_ = 0;
  Samples start_;
  double amplitude_ = 1.0;
  double weight_scale_ = 1.0;
  double floor_ = 0.0;  // of the deviation, 1/m
};

// Pixels that the lens' blur mixes with what lies beyond an edge, and the part of a narrow ring that must remain.
constexpr double kMixed_px = 2.2;
constexpr double kMostMargin = 0.3;

}  // namespace

RingRegion ring_region(const ellipse::Ellipse& inner, const ellipse::Ellipse& outer) {
  const double width_px = std::min(outer.a_px - inner.a_px, outer.b_px - inner.b_px);
  const double margin_px = std::min(kMixed_px, kMostMargin * width_px);
  return {EllipseRows(inner, margin_px), EllipseRows(outer, -margin_px)};
}

std::optional<PlaneFit> fit_plane(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                  const RingRegion& region) {
  return Fitter(frame, camera, rays, region).fit();
}

}  // namespace pharos::tof
