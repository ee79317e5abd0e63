// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace pharos::ellipse {
namespace {

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
    return size - reach <= max_size_ && size + reach >= min_size_;
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

bool may_touch(const Contact& contact, const Arc& arc) {
  if (!contact.may_touch_within(arc.about, arc.radius_px)) return false;
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

// The contour cut into sectors of equal steps around the diamond |x| + |y| = 1: no trigonometry, and so identical on
// every machine.
class Sectors {
 public:
  Sectors(const Ellipse& e, std::int32_t width_px, std::int32_t height_px)
      : e_(e), right_(width_px - 1.0 - kBorder_px), bottom_(height_px - 1.0 - kBorder_px) {
    constexpr double kLength_px = 4.0;
    quarter_ = std::clamp(static_cast<int>(perimeter_px(e) / (4.0 * kLength_px)), 2, kMaxSectors / 4);
    cut_ = width_px > 0 && (e.cx_px - e.a_px < kBorder_px || e.cy_px - e.a_px < kBorder_px ||
                            e.cx_px + e.a_px > right_ || e.cy_px + e.a_px > bottom_);
  }

  // A point in units of the axes.
  void mark(PointF p) {
    const float across = std::abs(p.u) + std::abs(p.v);
    if (!(across > 0.0F)) return;
    const bool odd = (p.u < 0.0F) != (p.v < 0.0F);  // the step runs from the x axis to the y axis, or back
    const float fraction = (odd ? std::abs(p.u) : std::abs(p.v)) / across;
    const int quadrant = p.v >= 0.0F ? (p.u >= 0.0F ? 0 : 1) : (p.u < 0.0F ? 2 : 3);
    const int step = std::min(quarter_ - 1, static_cast<int>(fraction * static_cast<float>(quarter_)));
    marked_ |= std::uint64_t{1} << (quadrant * quarter_ + step);
  }

  void fractions(Support& support) const {
    // Of a quarter from the x axis to the y axis, then of one back: each comes twice.
    std::array<double, kMaxSectors / 2> lengths, turns;
    for (int k = 0; k < 2 * quarter_; ++k) {
      const bool odd = k >= quarter_;
      const double fraction = ((odd ? k - quarter_ : k) + 0.5) / quarter_;
      const double x = odd ? fraction : 1.0 - fraction, y = 1.0 - x;  // on the diamond; |x + y| = 1 there
      const double squared = x * x + y * y;
      const double anomaly = 1.0 / squared;  // dt a step, but for a factor: dt = (x^2 + y^2)^-1 dshare
      const double slant = (e_.a_px * e_.a_px * y * y + e_.b_px * e_.b_px * x * x) / squared;
      lengths[static_cast<std::size_t>(k)] = std::sqrt(slant) * anomaly;
      turns[static_cast<std::size_t>(k)] = anomaly / slant;
    }
    double length = 0.0, turn = 0.0, inside_length = 0.0, inside_turn = 0.0, all_length = 0.0, all_turn = 0.0;
    const double c = std::cos(e_.theta_rad), s = std::sin(e_.theta_rad);
    for (int k = 0; k < 4 * quarter_; ++k) {
      const auto step = static_cast<std::size_t>(k < 2 * quarter_ ? k : k - 2 * quarter_);
      all_length += lengths[step];
      all_turn += turns[step];
      const bool marked = (marked_ >> k & 1U) != 0;
      if (!marked && cut_ && outside(k, c, s)) continue;
      inside_length += lengths[step];
      inside_turn += turns[step];
      if (!marked) continue;
      length += lengths[step];
      turn += turns[step];
    }
    support.length_fraction = length / all_length;
    support.turn_fraction = turn / all_turn;
    support.inside_fraction = inside_length / all_length;
    support.inside_turn = inside_turn / all_turn;
  }

 private:
  // Whether a sector's middle is outside the image.
  bool outside(int sector, double cosine, double sine) const {
    const int quadrant = sector / quarter_;
    const double fraction = (sector % quarter_ + 0.5) / quarter_;
    const bool odd = quadrant % 2 != 0;  // the step runs from the y axis to the x axis
    const double x = odd ? fraction : 1.0 - fraction, y = 1.0 - x;
    const double length = std::sqrt(x * x + y * y);
    const double along = e_.a_px * (quadrant == 1 || quadrant == 2 ? -x : x) / length;
    const double across = e_.b_px * (quadrant >= 2 ? -y : y) / length;
    const double u = e_.cx_px + cosine * along - sine * across, v = e_.cy_px + sine * along + cosine * across;
    return u < kBorder_px || v < kBorder_px || u > right_ || v > bottom_;
  }

  const Ellipse& e_;
  double right_, bottom_;
  bool cut_ = false;  // by the image's border
  int quarter_;
  std::uint64_t marked_ = 0;
};

}  // namespace

void collect_support(const Ellipse& ellipse, bool bright_inside, double gate_px, const EllipseWorkspace& workspace,
                     Support& support) {
  support.clear();
  const Contact contact(ellipse, bright_inside, gate_px);
  Sectors sectors(ellipse, workspace.width_px, workspace.height_px);
  StaticVector<std::uint16_t, kMaxArcs> touching;
  std::uint32_t possible = 0;
  for (std::size_t k = 0; k < workspace.arcs.size(); ++k) {
    if (!may_touch(contact, workspace.arcs[k])) continue;
    touching.push_back(static_cast<std::uint16_t>(k));
    possible += workspace.arcs[k].points();
  }
  support.stride = 1 + possible / static_cast<std::uint32_t>(kMaxFitPoints);
  double squares = 0.0;
  for (const std::uint16_t k : touching) {
    const Arc& arc = workspace.arcs[k];
    const std::uint32_t count =
        for_points_on(contact, arc, workspace, [&](PointF place, float distance, float squared) {
          squares += static_cast<double>(squared);
          support.distance_sum_px += std::abs(static_cast<double>(distance));
          if (support.count++ % support.stride != 0) return;
          support.points.push_back(place);
          sectors.mark(contact.scaled(place));
        });
    if (count > 0) ++support.arcs;
  }
  if (support.count > 0) support.squared_gradient = squares / support.count;
  sectors.fractions(support);
}

std::uint32_t points_on(const Ellipse& ellipse, bool bright_inside, double gate_px, const Arc& arc,
                        const EllipseWorkspace& workspace) {
  const Contact contact(ellipse, bright_inside, gate_px);
  if (!contact.may_touch_within(arc.about, arc.radius_px)) return 0;
  return for_points_on(contact, arc, workspace, [](PointF, float, float) {});
}

}  // namespace pharos::ellipse
