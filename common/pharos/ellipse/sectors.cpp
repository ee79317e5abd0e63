// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/sectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {
namespace {

std::uint64_t all_of(int count) { return ~std::uint64_t{0} >> (kMaxSectors - count); }

// Those before and after each, around the contour.
std::uint64_t neighbours(std::uint64_t sectors, int count) {
  return (sectors << 1U | sectors >> (count - 1) | sectors >> 1U | sectors << (count - 1)) & all_of(count);
}

}  // namespace

Sectors::Sectors(const Ellipse& e, std::int32_t width_px, std::int32_t height_px)
    : e_(e), right_(width_px - 1.0 - kBorder_px), bottom_(height_px - 1.0 - kBorder_px) {
  constexpr double kLength_px = 4.0;
  quarter_ = std::clamp(static_cast<int>(perimeter_px(e) / (4.0 * kLength_px)), 2, kMaxSectors / 4);
  cut_ = width_px > 0 && (e.cx_px - e.a_px < kBorder_px || e.cy_px - e.a_px < kBorder_px || e.cx_px + e.a_px > right_ ||
                          e.cy_px + e.a_px > bottom_);
}

int Sectors::sector_of(PointF p) const {
  const float across = std::abs(p.u) + std::abs(p.v);
  const bool odd = (p.u < 0.0F) != (p.v < 0.0F);  // the step runs from the x axis to the y axis, or back
  const float fraction = across > 0.0F ? (odd ? std::abs(p.u) : std::abs(p.v)) / across : 0.0F;
  const int quadrant = p.v >= 0.0F ? (p.u >= 0.0F ? 0 : 1) : (p.u < 0.0F ? 2 : 3);
  return quadrant * quarter_ + std::min(quarter_ - 1, static_cast<int>(fraction * static_cast<float>(quarter_)));
}

ContourFractions Sectors::fractions() const {
  if (marked_ == all_of(count())) return {1.0, 1.0, 1.0, 1.0};
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
  return {length / all_length, turn / all_turn, inside_length / all_length, inside_turn / all_turn};
}

std::uint64_t with_neighbours(std::uint64_t sectors, int count) { return sectors | neighbours(sectors, count); }

std::uint64_t Sectors::beside_gaps(int reach) const {
  const int count = 4 * quarter_;
  std::uint64_t gaps = ~marked_ & all_of(count);
  if (gaps != 0 && cut_) {
    const double c = std::cos(e_.theta_rad), s = std::sin(e_.theta_rad);
    for (int k = 0; k < count; ++k) {
      if ((gaps >> k & 1U) != 0 && outside(k, c, s)) gaps &= ~(std::uint64_t{1} << k);
    }
  }
  std::uint64_t beside = gaps & neighbours(gaps, count);
  for (int k = 0; k < reach; ++k) beside |= neighbours(beside, count);
  return beside;
}

// Whether a sector's middle is outside the image.
bool Sectors::outside(int sector, double cosine, double sine) const {
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

}  // namespace pharos::ellipse
