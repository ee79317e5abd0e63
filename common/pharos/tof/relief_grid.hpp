// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

/// Cells across: 10 mm each for the largest rings' surroundings, a seventh of a connector.
inline constexpr int kMaxGridSide = 192;
/// Pixels higher over the ring's plane are before the satellite and hide it; deeper ones count as this deep. Metres.
inline constexpr double kMaxRelief_m = 0.25;

/// Heights over the ring's plane, seen along the plane's normal: square cells in the axes of axes_of(normal) about the
/// ring's centre, each the mean of its pixels' heights, weighted by amplitude (darker pixels are noisier), up to the
/// ring's own. A pixel belongs to the cell where its ray meets the ring's plane, so that noise of depth moves no pixel;
/// a face at another height is displaced as a whole. The ring and its walls are left out.
class ReliefGrid {
 public:
  struct Sum {
    double weight = 0.0;  ///< in pixels as bright as the ring
    double moment = 0.0;  ///< weight x height, m

    double height_m() const { return weight > 0.0 ? moment / weight : 0.0; }
  };

  /// `reach_m`: half the side of what is covered. Some 5 ns a pixel.
  void make(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring, double reach_m);

  int side() const { return side_; }
  double cell_m() const { return cell_m_; }
  /// Place of a cell's centre in the ring's plane, m; not only of whole cells.
  Vector2 place_of(double column, double row) const {
    return {(column + 0.5) * cell_m_ - reach_m_, (row + 0.5) * cell_m_ - reach_m_};
  }
  double column_of(double along_m) const { return (along_m + reach_m_) / cell_m_ - 0.5; }

  float weight(int column, int row) const { return weight_[index(column, row)]; }
  float height_m(int column, int row) const { return height_[index(column, row)]; }
  const float* weights_of(int row) const { return weight_.data() + index(0, row); }
  const float* heights_of(int row) const { return height_.data() + index(0, row); }
  /// Nothing was measured of the satellite, because something before it hides it.
  bool hidden(int column, int row) const { return !(weight(column, row) > 0.0F) && height_m(column, row) > 0.0F; }
  /// Of the cells in a square of 2 half + 1 about a cell, as far as they exist.
  Sum square(int column, int row, int half) const;

  static constexpr std::size_t kMaxCells = static_cast<std::size_t>(kMaxGridSide) * kMaxGridSide;
  static std::size_t index(int column, int row) {
    return static_cast<std::size_t>(row) * kMaxGridSide + static_cast<std::size_t>(column);
  }

 private:
  void finish();

  int side_ = 0;
  double cell_m_ = 1.0;
  double reach_m_ = 0.0;
  // While pixels are added: sums in 1/256 of the ring's amplitude and in units of 0.25 mm.
  std::array<std::int32_t, kMaxCells> weight_sum_{};
  std::array<std::int32_t, kMaxCells> moment_sum_{};
  std::array<float, kMaxCells> weight_{};
  std::array<float, kMaxCells> height_{};
  // Sums over all cells before a row and column.
  static constexpr std::size_t kCorners = static_cast<std::size_t>(kMaxGridSide + 1) * (kMaxGridSide + 1);
  std::array<std::int64_t, kCorners> weights_before_{};
  std::array<std::int64_t, kCorners> moments_before_{};
};

}  // namespace pharos::tof
