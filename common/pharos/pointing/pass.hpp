// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/orbit.hpp"
#include "pharos/pointing/spin.hpp"

namespace pharos::pointing {

/// Attitude law of the panels during a pass, which the operator must state: planes of many images intersect only in a
/// frame in which the axis is fixed.
enum class AttitudeLaw : std::uint8_t {
  kInertial,  // fixed among the stars. Needs times and the station's position (the Earth turns 15 arcsec/s)
  kNadir,     // fixed against nadir and flight. Needs the orbit too: ranges, or times of a circular one
  kSpin,      // rotates steadily about a direction fixed among the stars; direction and rate are found
};
const char* name_of(AttitudeLaw law);

/// One image of a pass.
struct PassImage {
  Observation observation;
  AxisPlanes planes_station;
};

struct PassOptions {
  Geodetic station;
  AttitudeLaw law = AttitudeLaw::kInertial;
  /// Maximum spin rate of the search, rad/s. Reduced to what the images' spacing distinguishes from a slower one.
  double max_spin_rad_s = 0.0872664625997164788;  // 5 deg/s
};

/// Maximum planes of a pass: 2000 images of a panel's two edges.
inline constexpr std::size_t kMaxPassPlanes = 4096;
/// Fraction of images that may contradict the rest and be left out (another edge taken for the panel's).
inline constexpr double kMaxRejectedFraction = 0.05;
/// Chi-squared per degree of freedom up to which a law fits for any number of images: edges have small errors of their
/// own that are not in the noise (README).
inline constexpr double kFittingChi2 = 2.0;

enum class PassFailure : std::uint8_t {
  kTooFewImages,   // fewer than three with planes; a spin needs eight planes
  kTooManyImages,  // more than kMaxPassPlanes
  kNoOrbit,        // kNadir: the lines of sight are no Earth orbit, or too short
  kLawDoesNotFit,  // chi2: the axis did not move as stated
  kSpinNotSeen,    // kSpin: the axis did not rotate; inertial or nadir determine more
};
const char* name_of(PassFailure failure);

struct PassEstimate {
  /// The axis at `time_s` in S, with its sign, and of the same error in S.
  Vector3 axis_station = Vector3::UnitZ();
  Matrix3 covariance_station = Matrix3::Zero();
  double time_s = 0.0;  ///< the middle between first and last image
  /// In the frame in which it is fixed: I (E at time_s), or O (x flight, y against the orbit's normal, z nadir).
  Vector3 axis_law = Vector3::UnitZ();
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
  int images = 0;                              ///< used
  int rejected = 0;                            ///< contradict the rest
  std::optional<Orbit> orbit;                  ///< kNadir
  std::optional<SpinEstimate> spin;            ///< kSpin, in I
  std::optional<Vector3> second_axis_station;  /// kSpin: another solution that fits nearly as well

  double sigma_rad() const { return std::sqrt(covariance_station.trace()); }
};

/// Result of a pass. Where the law does not fit, the estimate still contains chi2, images and degrees of freedom.
struct PassSolution {
  std::optional<PassFailure> failure;
  PassEstimate estimate;
};

/// The planes of a pass in the law's frame, with their times; memory of estimate_pass.
struct PassWorkspace {
  StaticVector<AxisPlane, kMaxPassPlanes> planes;
  StaticVector<double, kMaxPassPlanes> seconds;
  StaticVector<std::int32_t, kMaxPassPlanes> image;
  StaticVector<Observation, kMaxPassPlanes> observations;
};

/// One axis from many images under a stated law, with the test whether the law fits: planes that contradict the rest
/// are left out, a few (kMaxRejectedFraction), and then chi-squared must agree with the planes' sigmas (99.99 %) or be
/// below kFittingChi2 per degree of freedom. Covariances grow by chi2 per degree of freedom where that is above 1.
PassSolution estimate_pass(std::span<const PassImage> images, const PassOptions& options, PassWorkspace& workspace);

/// Whether chi2 of so many degrees of freedom is explained by noise (99.99 %; Wilson and Hilferty 1931), or small
/// enough (kFittingChi2).
bool is_fitting(double chi2, int degrees_of_freedom);

}  // namespace pharos::pointing
