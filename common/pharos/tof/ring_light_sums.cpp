// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_light_sums.hpp"

#include <Eigen/Core>

namespace pharos::tof {
namespace {

// Single precision suffices for a direction's pixels, a few dozen.
using Lanes = Eigen::Array<float, static_cast<int>(kLightLanes), 1>;

// Per px of an edge: a pixel that says less of its place does not count for the noise that neighbours share.
constexpr float kMinSlope = 0.05F;
// A step from 0 to 1 within a thousandth or less, in place of a comparison.
constexpr float kSharp = 1e5F;
// A wall narrower than this part of the blur is not seen.
constexpr double kNarrowWall = 0.2;

// The same order on every machine.
double sum_of(const Lanes& lanes) { return static_cast<double>((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])); }

Lanes is_positive(const Lanes& x) { return (kSharp * x).max(0.0F).min(1.0F); }

// blurred_step (edge_profile.hpp) by truncated powers: without a branch.
struct LaneSteps {
  Lanes value, slope;
};
LaneSteps blurred_steps(const Lanes& x, float scale) {
  const Lanes t = (scale * x).max(-2.0F).min(2.0F);
  const Lanes a = t + 2.0F, b = (t + 1.0F).max(0.0F), c = t.max(0.0F), d = (t - 1.0F).max(0.0F);
  const Lanes a3 = a * a * a, b3 = b * b * b, c3 = c * c * c, d3 = d * d * d;
  return {(a3 * a - 4.0F * (b3 * b) + 6.0F * (c3 * c) - 4.0F * (d3 * d)) * (1.0F / 24.0F),
          (a3 - 4.0F * b3 + 6.0F * c3 - 4.0F * d3) * (scale / 6.0F)};
}

// The ring's profile at some pixels, and its derivatives.
struct LaneProfile {
  Lanes value;
  std::array<Lanes, RingLightSums::kUnknowns> by;
};

class DirectionProfile {
 public:
  DirectionProfile(const RingDirection& one, const RingProfile& profile)
      : side_(wall_side(one)),
        scale_(static_cast<float>(0.57735026918962576 / profile.blur_px)),  // of the spline's knots
        width_(static_cast<float>(one.width_px)),
        inner_scale_(static_cast<float>(one.inner_scale)),
        moved_{static_cast<float>(one.moved_px[0]), static_cast<float>(one.moved_px[1])},
        has_wall_(one.foot_px[side_] >= kNarrowWall * profile.blur_px),
        per_foot_(has_wall_ ? static_cast<float>(1.0 / one.foot_px[side_]) : 0.0F),
        wall_(static_cast<float>(one.wall[side_])),
        bright_(static_cast<float>(one.wall[side_] * profile.walls[side_])) {}

  LaneProfile at(const Lanes& beyond_px) const {
    const Lanes outer = beyond_px - moved_[0];
    const Lanes inner = width_ + inner_scale_ * beyond_px - moved_[1];
    const LaneSteps high = blurred_steps(-outer, scale_), low = blurred_steps(inner, scale_);
    LaneProfile result{high.value + low.value - 1.0F,
                       {high.slope, -low.slope, outer * high.slope - inner * low.slope, Lanes::Zero()}};
    if (has_wall_) {
      if (side_ == 0) {
        add_wall(outer, high, -1.0F, result);
      } else {
        add_wall(-inner, low, 1.0F, result);
      }
    }
    return result;
  }

 private:
  // `step`: from the wall's upper edge towards the face. It is darker towards its foot.
  void add_wall(const Lanes& beyond, const LaneSteps& step, float sign, LaneProfile& result) const {
    const Lanes ramp = (1.0F - beyond * per_foot_).max(0.0F).min(1.0F);
    const Lanes edge = 1.0F - step.value;
    const Lanes lit = ramp * edge;
    const Lanes falls = is_positive(ramp) * is_positive(1.0F - ramp) * per_foot_;
    const Lanes slope = ramp * step.slope - falls * edge;
    result.value += bright_ * lit;
    result.by[side_] += (sign * bright_) * slope;
    result.by[2] -= bright_ * (ramp * beyond * step.slope);
    result.by[3] = wall_ * lit;
  }

  std::size_t side_;
  float scale_, width_, inner_scale_;
  std::array<float, 2> moved_;
  bool has_wall_;
  float per_foot_, wall_, bright_;
};

// RingLightSums before the lanes are added up.
struct LaneSums {
  std::array<Lanes, 10> normal;
  std::array<Lanes, RingLightSums::kUnknowns> right, with_light;
  Lanes light_square = Lanes::Zero(), light_right = Lanes::Zero();
  struct Shared {
    Lanes count = Lanes::Zero(), weights = Lanes::Zero(), sum = Lanes::Zero(), squares = Lanes::Zero();
  };
  std::array<Shared, 2> shared;

  LaneSums() {
    normal.fill(Lanes::Zero());
    right.fill(Lanes::Zero());
    with_light.fill(Lanes::Zero());
  }

  void add(const LaneProfile& seen, const Lanes& residual, const Lanes& weight, float light) {
    const Lanes weighted_value = weight * seen.value, weighted_residual = weight * residual;
    light_square += weighted_value * seen.value;
    light_right += weighted_residual * seen.value;
    std::array<Lanes, RingLightSums::kUnknowns> row;
    std::size_t place = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = light * seen.by[i];
      right[i] += weighted_residual * row[i];
      with_light[i] += weighted_value * row[i];
      const Lanes weighted = weight * row[i];
      for (std::size_t k = 0; k <= i; ++k) normal[place++] += weighted * row[k];
    }
    for (std::size_t e = 0; e < 2; ++e) {
      const Lanes counts = is_positive(seen.by[e].abs() - kMinSlope);
      shared[e].count += counts;
      shared[e].weights += counts * row[e] * row[e];
      shared[e].sum += counts * weighted_residual * row[e];
      shared[e].squares += counts * weighted_residual * weighted_residual;
    }
  }

  RingLightSums sums() const {
    RingLightSums result;
    for (std::size_t i = 0; i < normal.size(); ++i) result.normal[i] = sum_of(normal[i]);
    for (std::size_t i = 0; i < right.size(); ++i) {
      result.right[i] = sum_of(right[i]);
      result.with_light[i] = sum_of(with_light[i]);
    }
    result.light_square = sum_of(light_square);
    result.light_right = sum_of(light_right);
    for (std::size_t e = 0; e < 2; ++e) {
      result.shared[e] = {sum_of(shared[e].count), sum_of(shared[e].weights), sum_of(shared[e].sum),
                          sum_of(shared[e].squares)};
    }
    return result;
  }
};

}  // namespace

RingLightSums light_sums(const RingDirection& one, std::size_t direction, const RingProfile& profile,
                         RingLightColumns& columns) {
  const DirectionProfile across(one, profile);
  const auto light = static_cast<float>(one.light);
  const float limit = profile.limit > 0.0 ? static_cast<float>(profile.limit) : 1e30F;
  const std::size_t begin = columns.begin[direction], end = begin + columns.count[direction];
  LaneSums sums;
  for (std::size_t k = begin; k < end; k += kLightLanes) {
    const LaneProfile seen = across.at(Lanes::Map(columns.beyond_px.data() + k));
    const Lanes residual = Lanes::Map(columns.layer.data() + k) - light * seen.value;
    const Lanes size = residual.abs();
    Lanes::Map(columns.size.data() + k) = size;
    sums.add(seen, residual, (limit / size.max(1e-6F)).min(1.0F), light);
  }
  return sums.sums();
}

}  // namespace pharos::tof
