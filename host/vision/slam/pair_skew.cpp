// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pair_skew.hpp"

#include <cmath>

namespace pharos::slam {
namespace {

constexpr double kFade = 0.97;       // a frame: some 30 frames count
constexpr double kMinFrames = 12.0;  // faded ones
constexpr double kMinSkewPoints = 1000.0;
constexpr double kMinMoved_px = 0.25;  // scatter (1 sigma) of rows moved
constexpr double kSigma = 0.1;         // of the slope, in frames
// Images several frames apart match only where little moved, and that too seldom for such a sigma; but the slope is far
// from 0, and rows off follow it by more than a bent rectification puts them.
constexpr double kCertain = 10.0;  // sigmas
constexpr double kMinMovedThen_px = 0.15;
constexpr double kMinOff_px = 0.3;
// Neighbouring points' rows err alike (rectification, texture): the sigma counts every third point.
constexpr double kPointsAlike = 3.0;

}  // namespace

void PairSkew::add(double moved_px, double off_px) {
  count_ += 1.0;
  x_ += moved_px;
  y_ += off_px;
  xx_ += moved_px * moved_px;
  xy_ += moved_px * off_px;
  yy_ += off_px * off_px;
}

void PairSkew::end_frame() {
  for (double* sum : {&count_, &x_, &y_, &xx_, &xy_, &yy_, &frames_}) *sum *= kFade;
  frames_ += 1.0;
}

std::optional<double> PairSkew::frames_late() const {
  if (frames_ < kMinFrames || count_ < kMinSkewPoints) return std::nullopt;
  const double xx = xx_ / count_ - x_ * x_ / (count_ * count_);
  const double xy = xy_ / count_ - x_ * y_ / (count_ * count_);
  const double yy = yy_ / count_ - y_ * y_ / (count_ * count_);
  if (!(xx > kMinMovedThen_px * kMinMovedThen_px)) return std::nullopt;
  const double slope = xy / xx;
  const double rest = std::fmax(0.0, yy - slope * xy);
  const double sigma = std::sqrt(kPointsAlike * rest / (xx * count_)), moved = std::sqrt(xx);
  if (moved > kMinMoved_px && sigma <= kSigma) return slope;
  if (std::abs(slope) >= kCertain * sigma && std::abs(slope) * moved > kMinOff_px) return slope;
  return std::nullopt;
}

}  // namespace pharos::slam
