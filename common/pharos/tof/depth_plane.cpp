// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/depth_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/tof/constants.hpp"
#include "pharos/tof/ransac_sampler.hpp"
#include "pharos/tof/sector_sums.hpp"

namespace pharos::tof {
namespace {

// Pixels from which the start is chosen, and triples tried: with 55 % good pixels all triples are bad once in 50,000.
constexpr std::int32_t kStartPixels = 300;
constexpr int kPlaneTriples = 64;
// Deviations within which a pixel belongs to the plane.
constexpr double kPlaneGate = 3.0;
constexpr int kPasses = 3;
// Amplitude's weight stays within this factor of the median's, so that a glint does not dominate.
constexpr double kMaxWeight = 4.0;

// In columns, as compilers take two at a time.
struct PlaneSamples {
  using Column = std::array<double, static_cast<std::size_t>(kStartPixels)>;
  Column ray_x, ray_y, inverse_z;
  std::size_t count = 0;
};

// Sums of a pass: normal equations of 1/z = q . (x, y, 1), and the residuals about the previous q.
struct Sums {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0, x = 0.0, y = 0.0, weights = 0.0;
  double right_x = 0.0, right_y = 0.0, right = 0.0;
  SectorSums residuals;

  void add(double ray_x, double ray_y, double inverse_z, double weight) {
    const double weighted_x = weight * ray_x, weighted_y = weight * ray_y, weighted = weight * inverse_z;
    xx += weighted_x * ray_x;
    xy += weighted_x * ray_y;
    yx += weighted_y * ray_x;  // rounded otherwise than xy
    yy += weighted_y * ray_y;
    x += weighted_x;
    y += weighted_y;
    weights += weight;
    right_x += weighted * ray_x;
    right_y += weighted * ray_y;
    right += weighted;
  }
  Matrix3 normal() const {
    Matrix3 m;
    m << xx, xy, x, yx, yy, y, x, y, weights;
    return m;
  }
};

// Some neighbouring pixels of a row, processed together: what compilers take two at a time.
constexpr std::int32_t kPiece_px = 64;
using Column = std::array<double, static_cast<std::size_t>(kPiece_px)>;
struct Piece {
  Column inverse_z, residual, weight, weighted_square;
};

enum class Pass { kFit, kLast };  // sectors are needed of the last one only

class Fitter {
 public:
  Fitter(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingRegion& region)
      : frame_(frame), camera_(camera), rays_(rays), region_(region) {}

  std::optional<PlaneFit> fit() {
    count();
    if (with_depth_ < kMinPlanePixels) return std::nullopt;
    take_start_pixels();
    Vector3 q;
    double sigma = start(q);
    if (!(sigma > 0.0)) return std::nullopt;
    Sums sums;
    for (int pass = 0; pass < kPasses; ++pass) {
      sums = summed(q, kPlaneGate * sigma, Pass::kFit);
      if (sums.residuals.count() < kMinPlanePixels) return std::nullopt;
      const Vector3 next = sums.normal().inverse() * Vector3(sums.right_x, sums.right_y, sums.right);
      if (!next.allFinite()) return std::nullopt;
      q = next;
      sigma = std::max(floor_, kGateLoss * std::sqrt(sums.residuals.variance()));
    }
    if (!(q.z() > 0.0)) return std::nullopt;
    return answer(q, sigma);
  }

 private:
  // A normal distribution cut at kPlaneGate has a deviation smaller than the whole by this factor.
  static constexpr double kGateLoss = 1.0 / 0.98657;

  template <class Visit>
  void for_each_span(Visit visit) const {
    for_each_span_between(region_.inner, region_.outer, frame_.depth.width_px, frame_.depth.height_px, visit);
  }

  void count() {
    for_each_span([&](std::int32_t v, PixelSpan span) {
      const std::uint16_t* depth = frame_.depth.row(v);
      pixels_ += span.last - span.first + 1;
      for (std::int32_t u = span.first; u <= span.last; ++u) with_depth_ += has_depth(depth[u]) ? 1 : 0;
    });
  }

  // Evenly over the region; weights are relative to their median amplitude.
  void take_start_pixels() {
    std::int32_t due = 0;  // one is taken whenever this reaches the number of pixels
    std::array<std::uint16_t, kStartPixels> amplitudes{};
    for_each_span([&](std::int32_t v, PixelSpan span) {
      const std::uint16_t* depth = frame_.depth.row(v);
      for (std::int32_t u = span.first; u <= span.last; ++u) {
        if (!has_depth(depth[u])) continue;
        due += kStartPixels;
        if (due < with_depth_) continue;
        due %= with_depth_;
        if (!(depth_z_m(camera_, depth[u]) > 0.0) || start_.count == amplitudes.size()) continue;
        const Vector2 ray = rays_.at(u, v);
        amplitudes[start_.count] = frame_.intensity.at(u, v);
        start_.ray_x[start_.count] = ray.x();
        start_.ray_y[start_.count] = ray.y();
        start_.inverse_z[start_.count++] = 1.0 / depth_z_m(camera_, depth[u]);
      }
    });
    const auto middle = amplitudes.begin() + static_cast<std::ptrdiff_t>(start_.count / 2);
    std::nth_element(amplitudes.begin(), middle, amplitudes.begin() + static_cast<std::ptrdiff_t>(start_.count));
    amplitude_ = std::max<double>(1.0, *middle);
    weight_scale_ = 1.0 / (amplitude_ * amplitude_);
    // Noiseless depths still differ by their rounding.
    floor_ = start_.count == 0 ? 0.0 : camera_.depth_scale_m * start_.inverse_z[0] * start_.inverse_z[0];
  }

  // Least median of squares; the deviation that goes with it, 1/m.
  double start(Vector3& best) const {
    const std::size_t count = start_.count;
    if (count < kMinPlanePixels / 2) return 0.0;
    RansacSampler ransac_sampler;
    double best_median = -1.0;
    PlaneSamples::Column distance;
    for (int k = 0; k < kPlaneTriples; ++k) {
      Matrix3 rows;
      Vector3 right;
      for (int i = 0; i < 3; ++i) {
        const std::size_t one = ransac_sampler.below(count);
        rows.row(i) << start_.ray_x[one], start_.ray_y[one], 1.0;
        right[i] = start_.inverse_z[one];
      }
      const Vector3 q = rows.inverse() * right;
      if (!q.allFinite()) continue;
      const double qx = q.x(), qy = q.y(), qz = q.z();
      for (std::size_t i = 0; i < count; ++i) {
        distance[i] = std::fabs(start_.inverse_z[i] - (qx * start_.ray_x[i] + qy * start_.ray_y[i] + qz));
      }
      std::size_t nearer = 0;
      for (std::size_t i = 0; i < count; ++i) nearer += distance[i] < best_median ? 1U : 0U;
      if (best_median >= 0.0 && nearer <= count / 2) continue;  // the median is not smaller
      const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(count / 2);
      std::nth_element(distance.begin(), middle, distance.begin() + static_cast<std::ptrdiff_t>(count));
      best_median = *middle;
      best = q;
    }
    return best_median < 0.0 ? 0.0 : std::max(kMedianToSigma * best_median, floor_);
  }

  // Pixels (first + k, v), k < count, whose rays these are.
  void look_at(std::int32_t first, std::int32_t v, std::int32_t count, const double* ray_x, const double* ray_y,
               const Vector3& q, Piece& piece) const {
    const std::uint16_t* depth = frame_.depth.row(v) + first;
    const std::uint16_t* light = frame_.intensity.row(v) + first;
    const double scale = camera_.depth_scale_m, origin = camera_.depth_origin_z_m, weight_scale = weight_scale_;
    const double qx = q.x(), qy = q.y(), qz = q.z();
    for (std::int32_t i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double amplitude = light[i];
      const double inverse_z = 1.0 / (depth[i] * scale + origin);
      const double residual = inverse_z - (qx * ray_x[i] + qy * ray_y[i] + qz);
      const double weight = std::clamp(amplitude * amplitude * weight_scale, 1.0 / kMaxWeight, kMaxWeight);
      piece.inverse_z[k] = inverse_z;
      piece.residual[k] = residual;
      piece.weight[k] = weight;
      piece.weighted_square[k] = residual * residual * weight;
    }
  }

  Sums summed(const Vector3& q, double gate, Pass pass) const {
    Sums sums;
    RayGrid::Row<double> rays;
    Piece piece;
    const double middle_u = 0.5 * (region_.outer.left_px() + region_.outer.right_px());
    const double middle_v = 0.5 * (region_.outer.top_px() + region_.outer.bottom_px());
    for_each_span([&](std::int32_t v, PixelSpan span) {
      const std::uint16_t* depth = frame_.depth.row(v);
      rays_.row_at(span.first, v, span.last - span.first + 1, rays);
      for (std::int32_t begin = span.first; begin <= span.last; begin += kPiece_px) {
        const std::int32_t count = std::min(kPiece_px, span.last - begin + 1);
        const double *ray_x = rays.x() + (begin - span.first), *ray_y = rays.y() + (begin - span.first);
        look_at(begin, v, count, ray_x, ray_y, q, piece);
        for (std::int32_t i = 0; i < count; ++i) {
          const auto k = static_cast<std::size_t>(i);
          if (!has_depth(depth[begin + i]) || !(piece.weighted_square[k] < gate * gate)) continue;
          sums.add(ray_x[i], ray_y[i], piece.inverse_z[k], piece.weight[k]);
          if (pass == Pass::kLast) {
            sums.residuals.add(begin + i - middle_u, v - middle_v, piece.weight[k], piece.residual[k]);
          } else {
            sums.residuals.add(piece.weight[k], piece.residual[k]);
          }
        }
      }
    });
    return sums;
  }

  std::optional<PlaneFit> answer(const Vector3& q, double sigma) const {
    const Sums sums = summed(q, kPlaneGate * sigma, Pass::kLast);
    const std::int32_t used = sums.residuals.count();
    if (used < kMinPlanePixels) return std::nullopt;
    PlaneFit fit;
    fit.plane.q = q;
    fit.pixels = used;
    fit.margin_px = region_.margin_px;
    fit.amplitude = amplitude_;
    fit.inlier_fraction = static_cast<double>(used) / pixels_;
    const double mean_inverse_z = sums.right / sums.weights;
    fit.rms_m = sigma / (mean_inverse_z * mean_inverse_z);
    fit.variance_inflation = sums.residuals.variance_inflation(3);
    fit.information = sums.normal() / (sigma * sigma * fit.variance_inflation);
    return fit;
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingRegion& region_;
  std::int32_t pixels_ = 0;
  std::int32_t with_depth_ = 0;
  PlaneSamples start_;
  double amplitude_ = 1.0;
  double weight_scale_ = 1.0;
  double floor_ = 0.0;  // of the deviation, 1/m
};

// Pixels that the lens' blur mixes with the region beyond an edge, and the part of a narrow ring that must remain.
constexpr double kMixed_px = 2.2;
constexpr double kMaxMargin = 0.3;

}  // namespace

RingRegion ring_region(const ellipse::Ellipse& inner, const ellipse::Ellipse& outer) {
  const double width_px = std::min(outer.a_px - inner.a_px, outer.b_px - inner.b_px);
  const double margin_px = std::min(kMixed_px, kMaxMargin * width_px);
  return {EllipseRows(inner, margin_px), EllipseRows(outer, -margin_px), margin_px};
}

std::optional<PlaneFit> fit_plane(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                  const RingRegion& region) {
  return Fitter(frame, camera, rays, region).fit();
}

}  // namespace pharos::tof
