// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "pharos/ellipse/sectors.hpp"

namespace pharos::ellipse {
namespace {

// Neighbouring edge points share pixels through the filter: with sigma = 1 px their noise is that of one measurement in
// 3.5 px (the sum of exp(-d^2/4) over the distances d).
constexpr double kCorrelation_px = 3.5;
constexpr float kMinSupportAlignment = 0.906F;  // cos 25 deg
// Maximum rounding error of a square.
constexpr float kNearly = 1.0001F;

// The contour in single precision, ready for many points.
class Contact {
 public:
  Contact(const Ellipse& e, bool bright_inside, double gate_px)
      : cx_(static_cast<float>(e.cx_px)),
        cy_(static_cast<float>(e.cy_px)),
        cos_(static_cast<float>(std::cos(e.theta_rad))),
        sin_(static_cast<float>(std::sin(e.theta_rad))),
        over_a_(static_cast<float>(1.0 / e.a_px)),
        over_b_(static_cast<float>(1.0 / e.b_px)),
        sign_(bright_inside ? -1.0F : 1.0F),
        gate_(static_cast<float>(gate_px)) {
    // |q^2 - 1| <= gate |slope| and |slope| <= 2 |q| / b bound the size of q.
    const double fraction = gate_px / e.b_px;
    const double root = std::sqrt(1.0 + fraction * fraction);
    min_size_ = static_cast<float>(root - fraction);
    max_size_ = static_cast<float>(root + fraction);
  }

  // In units of the axes: on the unit circle where the point is on the contour.
  PointF scaled(PointF p) const {
    const float u = p.u - cx_, v = p.v - cy_;
    return {(cos_ * u + sin_ * v) * over_a_, (cos_ * v - sin_ * u) * over_b_};
  }
  // Whether a point within `radius_px` of `about` can touch: sizes of q differ by no more than radius / b.
  bool may_touch_within(PointF about, float radius_px) const {
    constexpr float kRounding = 1e-3F;
    const PointF q = scaled(about);
    const float size = std::sqrt(q.u * q.u + q.v * q.v);
    const float reach = radius_px * over_b_ + kRounding * (1.0F + size);
    const bool inside = size - reach <= max_size_, outside = size + reach >= min_size_;
    return inside & outside;  // without a branch
  }
  // False for most points, without a root or a branch.
  bool may_touch(PointF p) const {
    const PointF q = scaled(p);
    const float x = q.u * over_a_, y = q.v * over_b_;
    const float f = q.u * q.u + q.v * q.v - 1.0F;
    return f * f <= kNearly * gate_ * gate_ * (4.0F * (x * x + y * y));
  }
  // For a point that may: its distance to first order; false off the gate or where the gradient differs from the
  // normal's direction.
  bool touches(PointF p, PointF gradient, float& distance) const {
    const PointF q = scaled(p);
    const float x = q.u * over_a_, y = q.v * over_b_;
    const float f = q.u * q.u + q.v * q.v - 1.0F;
    const float slope = std::sqrt(4.0F * (x * x + y * y));
    if (std::abs(f) > gate_ * slope) return false;
    distance = f / slope;
    const float gx = cos_ * gradient.u + sin_ * gradient.v, gy = cos_ * gradient.v - sin_ * gradient.u;
    const float along = sign_ * (gx * x + gy * y);
    return along > 0.0F &&
           4.0F * along * along >= kMinSupportAlignment * kMinSupportAlignment * slope * slope * (gx * gx + gy * gy);
  }

 private:
  float cx_, cy_, cos_, sin_, over_a_, over_b_, sign_, gate_;
  float min_size_, max_size_;  // of q where it touches
};

// Points processed together, as many as an arc has samples.
using Together = std::array<std::uint32_t, kArcSamples>;

// Calls take(number) for the arcs whose circles the contour may touch.
template <class Take>
void for_arcs_near(const Contact& contact, const EllipseWorkspace& workspace, Take&& take) {
  const ArcBounds& bounds = workspace.bounds;
  for (std::size_t begin = 0; begin < workspace.arcs.size(); begin += kArcSamples) {
    Together near;
    std::uint32_t any = 0;
    for (std::size_t k = 0; k < kArcSamples; ++k) {
      const std::size_t arc = begin + k;
      near[k] = contact.may_touch_within({bounds.u_px[arc], bounds.v_px[arc]}, bounds.radius_px[arc]) ? 1 : 0;
      any |= near[k];
    }
    if (any == 0) continue;
    const std::size_t count = std::min<std::size_t>(kArcSamples, workspace.arcs.size() - begin);
    for (std::size_t k = 0; k < count; ++k) {
      if (near[k] != 0) take(begin + k);
    }
  }
}

bool may_touch(const Contact& contact, const Arc& arc) {
  Together near;
  for (std::size_t k = 0; k < kArcSamples; ++k) near[k] = contact.may_touch(arc.samples[k]) ? 1 : 0;
  float distance = 0.0F;
  for (std::size_t k = 0; k < kArcSamples; ++k) {
    if (near[k] != 0 && contact.touches(arc.samples[k], arc.normals[k], distance)) return true;
  }
  return false;
}

// Calls take(point, distance, squared gradient) for every point of the arc on the contour; returns how many there were.
template <class Take>
std::uint32_t for_points_on(const Contact& contact, const Arc& arc, const EllipseWorkspace& workspace, Take&& take) {
  std::uint32_t count = 0;
  const auto look = [&](const EdgePoint& p) {
    const PointF place{p.u_px, p.v_px};
    const PointF gradient{static_cast<float>(p.gradient_u), static_cast<float>(p.gradient_v)};
    float distance = 0.0F;
    if (!contact.touches(place, gradient, distance)) return;
    take(place, distance, gradient.u * gradient.u + gradient.v * gradient.v);
    ++count;
  };
  const std::span<const EdgePoint> points(workspace.ordered.data() + arc.begin, arc.points());
  std::size_t begin = 0;
  for (; begin + kArcSamples <= points.size(); begin += kArcSamples) {
    Together near;
    for (std::size_t k = 0; k < kArcSamples; ++k) {
      near[k] = contact.may_touch({points[begin + k].u_px, points[begin + k].v_px}) ? 1 : 0;
    }
    for (std::size_t k = 0; k < kArcSamples; ++k) {
      if (near[k] != 0) look(points[begin + k]);
    }
  }
  for (; begin < points.size(); ++begin) {
    if (contact.may_touch({points[begin].u_px, points[begin].v_px})) look(points[begin]);
  }
  return count;
}

}  // namespace

double Support::independent() const { return std::min(1.0, stride / kCorrelation_px); }

void collect_support(const Ellipse& ellipse, bool bright_inside, double gate_px, const EllipseWorkspace& workspace,
                     Support& support) {
  support.clear();
  const Contact contact(ellipse, bright_inside, gate_px);
  Sectors sectors(ellipse, workspace.width_px, workspace.height_px);
  StaticVector<std::uint16_t, kMaxArcs> touching;
  std::uint32_t possible = 0;
  for_arcs_near(contact, workspace, [&](std::size_t k) {
    if (!may_touch(contact, workspace.arcs[k])) return;
    touching.push_back(static_cast<std::uint16_t>(k));
    possible += workspace.arcs[k].points();
  });
  support.stride = 1 + possible / static_cast<std::uint32_t>(kMaxFitPoints);
  double squares = 0.0, fourth_powers = 0.0;
  for (const std::uint16_t k : touching) {
    const Arc& arc = workspace.arcs[k];
    const std::uint32_t count =
        for_points_on(contact, arc, workspace, [&](PointF place, float distance, float squared) {
          squares += static_cast<double>(squared);
          fourth_powers += static_cast<double>(squared) * static_cast<double>(squared);
          support.distance_sum_px += std::abs(static_cast<double>(distance));
          if (support.count++ % support.stride != 0) return;
          const PointF scaled = contact.scaled(place);
          const int sector = sectors.sector_of(scaled);
          sectors.mark(sector);
          if (support.points.push_back(place)) {
            support.sectors.push_back(static_cast<std::uint8_t>(sector));
            support.squared_gradients.push_back(squared);
          }
        });
    if (count > 0) ++support.arcs;
  }
  if (support.count > 0) {
    support.squared_gradient = squares / support.count;
    const double mean = support.squared_gradient, spread = fourth_powers / support.count - mean * mean;
    support.gradient_variation = std::sqrt(std::max(0.0, spread)) / mean;
  }
  support.sector_count = sectors.count();
  const ContourFractions fractions = sectors.fractions();
  support.length_fraction = fractions.length;
  support.turn_fraction = fractions.turn;
  support.inside_fraction = fractions.inside_length;
  support.inside_turn = fractions.inside_turn;
  if (fractions.length < 1.0) support.beside_gaps = sectors.beside_gaps(sectors.count() < 24 ? 1 : 2);
}

void mark_arcs_on(const Ellipse& ellipse, bool bright_inside, double gate_px, double fraction,
                  const EllipseWorkspace& workspace, std::span<bool> marked) {
  const Contact contact(ellipse, bright_inside, gate_px);
  for_arcs_near(contact, workspace, [&](std::size_t k) {
    if (marked[k]) return;
    const Arc& arc = workspace.arcs[k];
    const std::uint32_t on = for_points_on(contact, arc, workspace, [](PointF, float, float) {});
    marked[k] = on >= fraction * arc.points();
  });
}

}  // namespace pharos::ellipse
