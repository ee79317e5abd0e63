// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "pharos/ellipse/ellipse.hpp"

namespace pharos::tof {

/// Pixels of one image row: first to last, both included; empty where last < first.
struct PixelSpan {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

/// An ellipse as the spans of pixels that it covers, row by row.
class EllipseRows {
 public:
  /// `grown_px` is added to both semi-axes.
  EllipseRows(const ellipse::Ellipse& shape, double grown_px) : cx_(shape.cx_px), cy_(shape.cy_px) {
    const double cosine = std::cos(shape.theta_rad);
    const double sine = std::sin(shape.theta_rad);
    const double a = std::max(0.5, shape.a_px + grown_px);
    const double b = std::max(0.5, shape.b_px + grown_px);
    const double p = 1.0 / (a * a);
    const double q = 1.0 / (b * b);
    uu_ = cosine * cosine * p + sine * sine * q;
    uv_ = cosine * sine * (p - q);
    vv_ = sine * sine * p + cosine * cosine * q;
    half_height_ = std::sqrt(uu_ / (p * q));
    half_width_ = std::sqrt(vv_ / (p * q));
  }

  /// Between which columns row v lies inside; empty above and below.
  PixelSpan at(std::int32_t v, std::int32_t width_px) const {
    const double dv = v - cy_;
    const double root = uv_ * uv_ * dv * dv - uu_ * (vv_ * dv * dv - 1.0);
    if (!(root > 0.0)) return {};
    const double middle = cx_ - uv_ * dv / uu_;
    const double half = std::sqrt(root) / uu_;
    return {static_cast<std::int32_t>(std::max(0.0, std::ceil(middle - half))),
            static_cast<std::int32_t>(std::min(width_px - 1.0, std::floor(middle + half)))};
  }
  /// Rows that it covers.
  PixelSpan rows(std::int32_t height_px) const {
    return {static_cast<std::int32_t>(std::max(0.0, std::ceil(cy_ - half_height_))),
            static_cast<std::int32_t>(std::min(height_px - 1.0, std::floor(cy_ + half_height_)))};
  }
  double left_px() const { return cx_ - half_width_; }
  double right_px() const { return cx_ + half_width_; }
  double top_px() const { return cy_ - half_height_; }
  double bottom_px() const { return cy_ + half_height_; }

 private:
  double cx_, cy_;
  double uu_, uv_, vv_;  // (p - c)^T [uu uv; uv vv] (p - c) = 1
  double half_width_, half_height_;
};

/// Calls visit(v, span) for every span of pixels of a width x height image inside `outer` and outside `inner`; no span
/// is empty.
template <class Visit>
void for_each_span_between(const EllipseRows& inner, const EllipseRows& outer, std::int32_t width_px,
                           std::int32_t height_px, Visit visit) {
  const PixelSpan rows = outer.rows(height_px);
  for (std::int32_t v = rows.first; v <= rows.last; ++v) {
    const PixelSpan all = outer.at(v, width_px);
    const PixelSpan hole = inner.at(v, width_px);
    const bool holed = hole.last >= hole.first;
    const std::int32_t left_end = holed ? std::min(all.last, hole.first - 1) : all.last;
    if (all.first <= left_end) visit(v, PixelSpan{all.first, left_end});
    if (!holed) continue;
    const std::int32_t right_begin = std::max(all.first, hole.last + 1);
    if (right_begin <= all.last) visit(v, PixelSpan{right_begin, all.last});
  }
}

}  // namespace pharos::tof
