// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "host/vision/pointing/edge_points.hpp"
#include "host/vision/pointing/edge_scan.hpp"

namespace pharos::pointing {

/// The median; `values` must not be empty.
double median(std::vector<double> values);

/// The mean of an edge's profiles about their own positions, less the rise that was fitted to each: what stands beside
/// the edge the same way all along it.
class ProfileStack {
 public:
  void add(const Profile& profile, const Rise& rise, double blur);
  /// Integral of the square of the mean residual beyond what the profiles' scatter explains, px of unit contrast.
  double excess_px() const;

 private:
  static constexpr std::size_t kBins = 128;
  static constexpr double kHalf_px = 16.0, kBin_px = 0.25;
  static constexpr int kMinInBin = 8;
  static constexpr double kNoiseSigmas = 2.0;
  std::array<double, kBins> sum_{}, squares_{};
  std::array<int, kBins> count_{};
};

/// What an edge's points have beside them: contrast, structure and what stands behind.
class EdgeSurroundings {
 public:
  EdgeSurroundings(const EdgeScan& scan, const ScanSettings& settings) : scan_(scan), settings_(settings) {}

  /// A point of the edge's first or second half.
  void add(const EdgeSample& one, bool is_second_half);
  /// Contrast, backing, backdrop and structure of the edge.
  void state(const TargetMask& target, MeasuredEdge& edge) const;

 private:
  const EdgeScan& scan_;
  const ScanSettings& settings_;
  std::array<ProfileStack, 2> halves_;
  std::vector<double> darks_, contrasts_, behind_;
};

}  // namespace pharos::pointing
