// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/box_fit.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tof {
namespace {

// Half sides tried at the seed, m, each in three turns.
constexpr std::array<double, 3> kHalfSides_m = {0.025, 0.04, 0.06};
constexpr int kSeedTurns = 3;
// Longer than any cover that is still fitted as one box.
constexpr double kMaxHalfSide_m = 0.2;
// Moves of a side, in cells: to a fifth of a cell, which noise does not exceed.
constexpr std::array<double, 3> kMoves = {1.5, 0.6, 0.2};
constexpr int kSweeps = 14;
// Logarithm of a connector's sides' ratio: the paper's limits of 0.7 and 1.5 are 2.5 deviations. Bars exist, at e^-10.
constexpr double kSlenderSigma = 0.15;
constexpr double kMaxPrior = 10.0;
// A strip beyond each side: past the mixed cells, and as wide as noise needs.
constexpr double kStripNear = 1.0;
constexpr double kStripFar = 3.0;
constexpr double kStripUsed = 0.8;  // of the side: corners are rounded
// Logarithm of the odds beyond which a strip goes on with the top.
constexpr double kCertain = 3.0;
// Fraction of a strip's cells that must have been measured.
constexpr double kMinMeasured = 0.25;
// And the fraction that may lie behind something.
constexpr double kMaxHidden = 0.15;

// The height of a box across a pair of its sides, of 1 on the top; in cells. Without branches: cells go by eight.
class WalledSide {
 public:
  WalledSide(float half, float foot)
      : half_(half),
        sign_(foot < 0.0F ? -1.0F : 1.0F),
        wall_(std::fabs(foot)),
        per_wall_(wall_ < kMinWall ? 0.0F : 1.0F / wall_),
        lit_(wall_ < kMinWall ? 0.0F : 1.0F) {}

  float reach() const { return half_ + wall_ + 1.0F; }
  // The height is zero outside of these, with a margin for rounding.
  float low() const { return sign_ < 0.0F ? -far_end() : -near_end(); }
  float high() const { return sign_ < 0.0F ? near_end() : far_end(); }
  float height(float place) const {
    const float inside = std::clamp(half_ + 0.5F - std::fabs(place), 0.0F, 1.0F);
    const float beyond = sign_ * place - half_;
    const float wall = lit_ * std::clamp(1.0F - beyond * per_wall_, 0.0F, 1.0F);
    return beyond < -0.5F ? inside : std::max(inside, wall);
  }

 private:
  static constexpr float kMinWall = 0.5F, kMargin = 0.02F;

  float near_end() const { return half_ + 0.5F + kMargin; }
  float far_end() const { return half_ + std::max(0.5F, wall_) + kMargin; }

  float half_, sign_, wall_, per_wall_, lit_;
};

// The columns of a row in which a box across two turned sides can have a height: what lies beside them adds nothing.
class RowSpan {
 public:
  RowSpan(const WalledSide& along, const WalledSide& across, float c, float s)
      : along_(along), across_(across), c_(c), s_(s) {}

  // Cuts [first, last], columns over the box' centre, at `dv` rows over it.
  void cut(float dv, float& first, float& last) const {
    within(s_ * dv, c_, along_, first, last);
    within(c_ * dv, -s_, across_, first, last);
  }

 private:
  // side.low() <= offset + slope column <= side.high()
  static void within(float offset, float slope, const WalledSide& side, float& first, float& last) {
    if (std::fabs(slope) < kSteepest) return;
    const float one = (side.low() - offset) / slope, other = (side.high() - offset) / slope;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  static constexpr float kSteepest = 1e-3F;

  const WalledSide& along_;
  const WalledSide& across_;
  float c_, s_;
};

class Voter {
 public:
  Voter(const ReliefGrid& grid, double height_m, double base_m, const Vector2& wall_slope)
      : grid_(grid), wall_slope_(wall_slope) {
    set(height_m, base_m);
  }

  void set(double height_m, double base_m) {
    base_ = static_cast<float>(base_m);
    height_ = static_cast<float>(height_m);
    foot_ = -(height_m - base_m) * wall_slope_;
    per_step_ = static_cast<float>(2.0 / std::max(1e-3, height_m - base_m));
  }
  // What is higher by a step than the top belongs to neither.
  float vote(int column, int row) const { return vote_at(grid_.height_m(column, row)); }
  float vote_at(float height) const {
    const float over = (height - base_) * per_step_ - 1.0F;
    const float under = 2.0F - 0.5F * (height - height_) * per_step_;
    return std::clamp(std::min(over, under), -1.0F, 1.0F);
  }

  // Calls visit(column, row, part of the cell inside) for cells that the rectangle touches.
  template <class Visit>
  void for_cells(const PlanarRectangle& r, Visit visit) const {
    const auto c = static_cast<float>(std::cos(r.angle_rad)), s = static_cast<float>(std::sin(r.angle_rad));
    const auto per_cell = static_cast<float>(1.0 / grid_.cell_m());
    const float a = static_cast<float>(r.half_sides_m.x()) * per_cell;
    const float b = static_cast<float>(r.half_sides_m.y()) * per_cell;
    const auto u0 = static_cast<float>(grid_.column_of(r.centre_m.x()));
    const auto v0 = static_cast<float>(grid_.column_of(r.centre_m.y()));
    const float wide = std::fabs(c) * a + std::fabs(s) * b + 1.0F, tall = std::fabs(s) * a + std::fabs(c) * b + 1.0F;
    const int left = std::max(0, static_cast<int>(std::ceil(u0 - wide)));
    const int right = std::min(grid_.side() - 1, static_cast<int>(std::floor(u0 + wide)));
    const int top = std::max(0, static_cast<int>(std::ceil(v0 - tall)));
    const int bottom = std::min(grid_.side() - 1, static_cast<int>(std::floor(v0 + tall)));
    for (int row = top; row <= bottom; ++row) {
      const float dv = static_cast<float>(row) - v0;
      for (int column = left; column <= right; ++column) {
        const float du = static_cast<float>(column) - u0;
        const float along = std::clamp(a + 0.5F - std::fabs(c * du + s * dv), 0.0F, 1.0F);
        const float across = std::clamp(b + 0.5F - std::fabs(c * dv - s * du), 0.0F, 1.0F);
        if (along * across > 0.0F) visit(column, row, along * across);
      }
    }
  }

  // Sum over the top and the walls in sight.
  float votes(const PlanarRectangle& r) const {
    const auto per_cell = static_cast<float>(1.0 / grid_.cell_m());
    const Vector2 first = r.outward(0), second = r.outward(1);
    const WalledSide along(static_cast<float>(r.half_sides_m.x()) * per_cell,
                           static_cast<float>(foot_.dot(first)) * per_cell);
    const WalledSide across(static_cast<float>(r.half_sides_m.y()) * per_cell,
                            static_cast<float>(foot_.dot(second)) * per_cell);
    const auto c = static_cast<float>(first.x()), s = static_cast<float>(first.y());
    const auto u0 = static_cast<float>(grid_.column_of(r.centre_m.x()));
    const auto v0 = static_cast<float>(grid_.column_of(r.centre_m.y()));
    const float reach_s = along.reach(), reach_t = across.reach();
    const float wide = std::fabs(c) * reach_s + std::fabs(s) * reach_t;
    const float tall = std::fabs(s) * reach_s + std::fabs(c) * reach_t;
    const int left = std::max(0, static_cast<int>(u0 - wide) + 1), top = std::max(0, static_cast<int>(v0 - tall) + 1);
    const int right = std::min(grid_.side() - 1, static_cast<int>(u0 + wide));
    const int bottom = std::min(grid_.side() - 1, static_cast<int>(v0 + tall));
    // Four sums side by side: one alone waits for each of its additions.
    constexpr int kSums = 4;
    std::array<float, kSums> sums{};
    std::array<float, static_cast<std::size_t>(kMaxGridSide + kSums)> of_row;
    const RowSpan span(along, across, c, s);
    for (int row = top; row <= bottom; ++row) {
      const float dv = static_cast<float>(row) - v0;
      float first_du = static_cast<float>(left) - u0, last_du = static_cast<float>(right) - u0;
      span.cut(dv, first_du, last_du);
      if (!(first_du <= last_du)) continue;
      // Each column has its sum, wherever the row begins.
      const int begin = left + (static_cast<int>(std::ceil(first_du + u0)) - left) / kSums * kSums;
      const int end = std::min(right, static_cast<int>(last_du + u0)) + 1;
      const float* weight = grid_.weights_of(row);
      const float* height = grid_.heights_of(row);
      for (int column = begin; column < end; ++column) {
        const float du = static_cast<float>(column) - u0;
        const float model = along.height(c * du + s * dv) * across.height(c * dv - s * du);
        const float x = 0.5F * (1.0F + vote_at(height[column]));
        of_row[static_cast<std::size_t>(column - begin)] = weight[column] * model * (2.0F * x - model);
      }
      const int count = end - begin;
      std::fill_n(of_row.begin() + count, kSums, 0.0F);
      for (int k = 0; k < count; k += kSums) {
        for (int i = 0; i < kSums; ++i) sums[static_cast<std::size_t>(i)] += of_row[static_cast<std::size_t>(k + i)];
      }
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

 private:
  const ReliefGrid& grid_;
  Vector2 wall_slope_;
  Vector2 foot_ = Vector2::Zero();  // of the walls, from their upper edges
  float base_ = 0.0F;
  float height_ = 0.0F;
  float per_step_ = 1.0F;
};

class BoxFitter {
 public:
  BoxFitter(const ReliefGrid& grid, const BoxSeed& seed)
      : grid_(grid),
        seed_(seed),
        voter_(grid, seed.height_m, seed.base_m, seed.wall_slope),
        height_m_(seed.height_m),
        base_m_(seed.base_m) {}

  BoxFit fit() {
    start(seed_.column, seed_.row);
    improve(kMoves[0]);
    measure_top();
    for (const double cells : kMoves) improve(cells);
    measure_top();
    float weight = 0.0F, votes = 0.0F;
    voter_.for_cells(rectangle_, [&](int u, int v, float part) {
      weight += part * grid_.weight(u, v);
      votes += part * grid_.weight(u, v) * voter_.vote(u, v);
    });
    BoxFit result{rectangle_, height_m_, base_m_, static_cast<double>(voter_.votes(rectangle_)), 0.0};
    if (weight > 0.0F) result.agreement = static_cast<double>(votes / weight);
    return result;
  }

 private:
  void start(int column, int row) {
    best_ = score(PlanarRectangle{grid_.place_of(column, row), 0.0, Vector2(kHalfSides_m[0], kHalfSides_m[0])});
    rectangle_ = {grid_.place_of(column, row), 0.0, Vector2(kHalfSides_m[0], kHalfSides_m[0])};
    for (const double half : kHalfSides_m) {
      for (int turn = 0; turn < kSeedTurns; ++turn) {
        try_rectangle({grid_.place_of(column, row), 0.5 * kPi * turn / kSeedTurns, Vector2(half, half)});
      }
    }
  }

  // Logarithm of the likelihood, and of the prior.
  double score(const PlanarRectangle& r) const {
    const double per_noise = (height_m_ - base_m_) / seed_.noise_m;
    const double slender = std::log(r.half_sides_m.x() / r.half_sides_m.y()) / kSlenderSigma;
    return 0.5 * per_noise * per_noise * static_cast<double>(voter_.votes(r)) -
           std::min(kMaxPrior, 0.5 * slender * slender);
  }
  bool try_rectangle(const PlanarRectangle& candidate) {
    const Vector2& half = candidate.half_sides_m;
    if (half.minCoeff() < 0.75 * grid_.cell_m() || half.maxCoeff() > kMaxHalfSide_m) return false;
    const double value = score(candidate);
    if (!(value > best_)) return false;
    best_ = value;
    rectangle_ = candidate;
    return true;
  }

  void improve(double cells) {
    const double by = cells * grid_.cell_m();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      bool better = false;
      for (int side = 0; side < 4; ++side) {
        for (const double sign : {1.0, -1.0}) better = move_side(side, sign * by) || better;
        PlanarRectangle shifted = rectangle_;
        shifted.centre_m += by * rectangle_.outward(side);
        better = try_rectangle(shifted) || better;
      }
      for (const double sign : {1.0, -1.0}) {
        PlanarRectangle turned = rectangle_;
        turned.angle_rad += sign * by / rectangle_.half_sides_m.maxCoeff();
        better = try_rectangle(turned) || better;
      }
      if (!better) break;
    }
  }
  bool move_side(int side, double by) {
    PlanarRectangle moved = rectangle_;
    moved.centre_m += 0.5 * by * rectangle_.outward(side);
    moved.half_sides_m[side % 2] += 0.5 * by;
    return try_rectangle(moved);
  }

  // Weighted mean of the cells inside that vote for the top.
  void measure_top() {
    float weights = 0.0F, moments = 0.0F;
    voter_.for_cells(rectangle_, [&](int u, int v, float part) {
      if (part < 1.0F || voter_.vote(u, v) < 0.0F) return;
      weights += grid_.weight(u, v);
      moments += grid_.weight(u, v) * grid_.height_m(u, v);
    });
    if (!(weights > 0.0F)) return;
    height_m_ = static_cast<double>(moments / weights);
    voter_.set(height_m_, base_m_);
    best_ = score(rectangle_);
  }

  const ReliefGrid& grid_;
  const BoxSeed& seed_;
  Voter voter_;
  double height_m_;
  double base_m_;
  PlanarRectangle rectangle_;
  double best_ = 0.0;
};

}  // namespace

BoxFit fit_box(const ReliefGrid& grid, const BoxSeed& seed) { return BoxFitter(grid, seed).fit(); }

BoxSides sides_of(const ReliefGrid& grid, const BoxFit& fit, double noise_m, const Vector2& wall_slope) {
  const Voter voter(grid, fit.height_m, fit.base_m, wall_slope);
  const double cell = grid.cell_m();
  const double per_noise = fit.step_m() / noise_m, unit = 0.5 * per_noise * per_noise;
  BoxSides sides;
  for (int side = 0; side < 4; ++side) {
    const Vector2 normal = fit.rectangle.outward(side);
    // In the ring's plane the wall's foot lies this far beyond its top.
    const double wall = std::max(0.0, -fit.step_m() * wall_slope.dot(normal));
    PlanarRectangle strip = fit.rectangle;
    const double near = kStripNear * cell + wall, far = kStripFar * cell + wall;
    strip.centre_m += (fit.rectangle.half_side(side) + 0.5 * (near + far)) * normal;
    strip.half_sides_m[side % 2] = 0.5 * (far - near);
    strip.half_sides_m[(side + 1) % 2] *= kStripUsed;
    double cells = 0.0, measured = 0.0, weight = 0.0, votes = 0.0, hidden = 0.0;
    voter.for_cells(strip, [&](int column, int row, float part) {
      const double w = static_cast<double>(part * grid.weight(column, row));
      cells += static_cast<double>(part);
      measured += w > 0.0 ? static_cast<double>(part) : 0.0;
      weight += w;
      votes += w * static_cast<double>(voter.vote(column, row));
      hidden += grid.hidden(column, row) ? static_cast<double>(part) : 0.0;
    });
    if (hidden > kMaxHidden * cells) ++sides.hidden;
    if (!(measured > kMinMeasured * cells) || !(weight > 0.0)) {
      ++sides.unknown;
    } else {
      sides.plate_log_odds -= votes * unit;
      sides.level += votes * unit > kCertain ? 1 : 0;
    }
  }
  return sides;
}

}  // namespace pharos::tof
