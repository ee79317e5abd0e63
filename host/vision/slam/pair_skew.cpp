// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pair_skew.hpp"

#include <cmath>

namespace pharos::slam {
namespace {

constexpr double kFade = 0.97;       // weight factor a frame: a memory of some 30 frames
constexpr double kMinFrames = 12.0;  // sum of weights
constexpr double kMinSkewPoints = 1000.0;
constexpr double kMinMoved_px = 0.25;  // scatter (1 sigma) of the motion in rows
constexpr double kSigma = 0.1;         // of the slope, in frames
// Images several frames apart match only where little moved, too seldom for such a sigma; but then the slope is far
// from 0, and the row differences it explains exceed those of a wrong rectification.
constexpr double kCertain = 10.0;  // sigmas
constexpr double kMinMovedThen_px = 0.15;
constexpr double kMinOff_px = 0.3;
// Row errors of neighbouring points are correlated (rectification, texture): the sigma counts every third point.
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
