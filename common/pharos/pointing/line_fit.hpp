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

/// Removes the lens' distortion: points of the image as taken become points of the ideal image (K times the ray). False
/// where the lens model has no ray for one of them; the points are then invalid.
bool undo_distortion(std::span<EdgePoint> points, const PinholeCamera& camera);

/// Minimum points of a line: with fewer the scatter cannot be estimated.
inline constexpr std::size_t kMinEdgePoints = 8;
/// Points farther than this from the line, in units of the points' own scatter, are left out.
inline constexpr double kOutlierSigmas = 3.5;
/// Maximum fraction of points that may be left out.
inline constexpr double kMaxLeftOut = 0.25;
/// Lower limit of a point's scatter, for noise-free input.
inline constexpr double kMinSigma_px = 1e-4;

enum class LineFailure : std::uint8_t {
  kTooFewPoints,
  kNotALine,  // more than kMaxLeftOut of the points are off it, or all coincide
};
const char* name_of(LineFailure failure);

struct LineFit {
  ImageLine line;
  double rms_px = 0.0;  ///< of the points used, across the line
  /// Number of neighbouring points with the same error (1: independent): points a pixel apart share pixels, and a lens'
  /// or a renderer's errors run along the edge. Below 1 (to 0.5) errors alternate. The covariance is larger by this.
  double variance_inflation = 1.0;
  std::size_t points = 0;              ///< used
  Vector2 begin_px = Vector2::Zero();  /// first and last of the used points, on the line
  Vector2 end_px = Vector2::Zero();

  double offset_px(const Vector2& place_px) const {
    return line.coefficients.head<2>().dot(place_px) + line.coefficients.z();
  }
  double length_px() const { return (end_px - begin_px).norm(); }
};

/// Straight line through points of the ideal image by orthogonal least squares, outliers left out. The covariance is
/// that of the points' scatter about the line and of its correlation along it.
Result<LineFit, LineFailure> fit_line(std::span<const EdgePoint> points);

/// The fit's line with the covariance widened by what scatter does not show: an error of `sigma_px` (1 sigma, across
/// the line) at either end, independent of each other, that bends the line as a whole. A strip of another brightness
/// beside the edge that is narrower than the blur, or the panel's thickness, shifts all points of a stretch alike.
/// Precondition: begin_px and end_px differ.
ImageLine with_end_errors(const LineFit& fit, double sigma_px);

}  // namespace pharos::pointing
