// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/pointing/axis_plane.hpp"

namespace pharos::pointing {

/// A measured point of an edge, in order along it.
struct EdgePoint {
  Vector2 place_px = Vector2::Zero();
  double sigma_px = 1.0;  ///< across the edge; only relative to one another: the fit finds the scale
};

/// Undoes the lens: places of the image as it was taken become places of the ideal image (K times the ray). False where
/// the lens model has no ray for one of them; the points are then of no use.
bool undo_distortion(std::span<EdgePoint> points, const PinholeCamera& camera);

/// Fewest points of a line: with fewer the scatter says nothing about itself.
inline constexpr std::size_t kMinEdgePoints = 8;
/// Points farther than this from the line, in units of the points' own scatter, are left out.
inline constexpr double kOutlierSigmas = 3.5;
/// Largest share of points that may be left out.
inline constexpr double kMaxLeftOut = 0.25;
/// What no edge point is better than: a floor for the scatter of noise-free input.
inline constexpr double kMinSigma_px = 1e-4;

enum class LineFailure : std::uint8_t {
  kTooFewPoints,
  kNotALine,  // more than kMaxLeftOut of the points lie off, or all in one place
};
const char* name_of(LineFailure failure);

struct LineFit {
  ImageLine line;
  double rms_px = 0.0;  ///< of the points used, across the line
  /// How many neighbouring points err alike (1: independent): points a pixel apart share pixels, and a lens' or a
  /// renderer's errors run along the edge. The covariance is larger by this.
  double variance_inflation = 1.0;
  std::size_t points = 0;              ///< used
  Vector2 begin_px = Vector2::Zero();  ///< where the used points begin and end, on the line
  Vector2 end_px = Vector2::Zero();

  double offset_px(const Vector2& place_px) const {
    return line.coefficients.head<2>().dot(place_px) + line.coefficients.z();
  }
  double length_px() const { return (end_px - begin_px).norm(); }
};

/// Straight line through points of the ideal image by orthogonal least squares, outliers left out. The covariance is
/// that of the points' scatter about the line and of its correlation along it.
Result<LineFit, LineFailure> fit_line(std::span<const EdgePoint> points);

}  // namespace pharos::pointing
