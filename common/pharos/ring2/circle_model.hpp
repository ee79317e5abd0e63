// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/geometry/types.hpp"
#include "pharos/optimize/least_squares.hpp"
#include "pharos/ring2/contour.hpp"
#include "pharos/ring2/rig.hpp"

namespace pharos::ring2 {

/// The model: two parallel circles with one axis, in the rig's frame.
struct CircleModel {
  Vector3 normal = -Vector3::UnitZ();  ///< unit, from the ring towards the cameras
  Vector3 centre_m = Vector3::Zero();  ///< of the first circle
  double radius_m = 0.0;
  double distance_m = 0.0;       ///< of the second circle's centre from the first's, along the normal
  double second_radius_m = 0.0;  ///< of the second circle
};

/// Two unit vectors across the normal, the axes of its tilt.
std::array<Vector3, 2> tilt_axes(const Vector3& normal);

/// The unknowns, in this order: tilt about the two axes (rad), centre (m), radius, distance, second radius (m).
inline constexpr int kUnknowns = 8;
enum Unknown : std::uint8_t { kTilt = 0, kCentre = 2, kRadius = 5, kDistance = 6, kSecondRadius = 7 };
using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

/// The model moved by a step of the unknowns.
CircleModel moved(const CircleModel& model, const Vector8& step);

/// Sums of the least squares over the ellipses; the cost is chi-squared.
struct NormalEquations : optimize::NormalEquations<kUnknowns> {
  double largest_rms_px = 0.0;  /// of the four contours' residuals, the largest
};

/// Which circle of the model a contour belongs to.
enum class Circle : std::uint8_t { kFirst, kSecond };

/// Adds one ellipse. The circle's points are projected through the whole camera and their offsets from the measured
/// ellipse are mapped to its five parameters by least squares along the contour, so that the distorted image of a
/// circle is compared with a least-distance ellipse of the same. False where the circle cannot be seen.
bool add_ellipse(const CircleModel& model, Circle circle, const RigView& view, const Contour& contour,
                 NormalEquations& sums);

/// The residual of one ellipse: the difference of the measured parameters, and its derivative by the unknowns. For
/// tests of the derivative.
struct ShapeResidual {
  Vector5 value = Vector5::Zero();
  Eigen::Matrix<double, 5, 8> slope = Eigen::Matrix<double, 5, 8>::Zero();
  double rms_px = 0.0;
};
std::optional<ShapeResidual> shape_residual(const CircleModel& model, Circle circle, const RigView& view,
                                            const Contour& contour);

}  // namespace pharos::ring2
