// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/result.hpp"
#include "pharos/ring2/circle_model.hpp"

namespace pharos::ring2 {

enum class Feature : std::uint8_t { kRing, kNozzle };
inline constexpr std::size_t kFeatures = 2;

/// Up to four measured ellipses of one instant: [view][feature].
using ContourSet = std::array<std::array<std::optional<Contour>, kFeatures>, kViews>;

enum class Ring2Failure : std::uint8_t {
  kRigIntrinsics,    // fault_of(rig)
  kRigRotation,      //
  kCamerasCoincide,  //
  kTooFewEllipses,   // fewer than two
  kBadEllipse,       // invalid axes, or pixels that the lens does not have
  kInconsistent,     // no two parallel circles before this rig give these ellipses
  kExchanged,        // they would fit if left and right were exchanged
  kUndetermined,     // the ellipses do not determine the unknowns
};
const char* name_of(Ring2Failure failure);

/// Quantities not observable from the given ellipses; the estimate's values of them are meaningless.
enum Unobservable : std::uint8_t {
  kUnobservableScale = 1,   ///< seen by one camera: neither lengths nor position
  kUnobservableRing = 2,    ///< no ring: neither its centre and radius nor the distance
  kUnobservableNozzle = 4,  ///< no nozzle: neither its radius nor the distance
};

/// theta and gamma of n = Rx(theta) Ry(gamma) (0, 0, -1).
struct Attitude {
  double theta_rad = 0.0;
  double gamma_rad = 0.0;
};
Attitude attitude_of(const Vector3& normal);
Vector3 normal_of(const Attitude& attitude);

/// Ring and nozzle, in the rig's frame.
struct Ring2Estimate {
  Vector3 normal = -Vector3::UnitZ();  ///< unit, from the ring towards the cameras
  Vector3 ring_centre_m = Vector3::Zero();
  Vector3 nozzle_centre_m = Vector3::Zero();  ///< ring centre + distance normal
  double ring_radius_m = 0.0;
  double nozzle_radius_m = 0.0;
  double distance_m = 0.0;
  std::uint8_t unobservable = 0;  ///< Unobservable bits

  /// Unit vectors across the normal, the axes of its tilt: n_true = n + tilt x n.
  std::array<Vector3, 2> tilt_axes{};
  /// Of (tilt about both axes, rad; centre, ring radius, distance, nozzle radius, m); zero for what is not observable.
  /// With kUnobservableRing centre and radius are the nozzle's.
  Matrix8 covariance = Matrix8::Zero();
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
  double rms_px = 0.0;  /// of the worst contour: distance of the circles' images from it
  int ellipses = 0;
  int iterations = 0;

  /// Present exactly when a second attitude fits nearly as well (delta chi2 < kAmbiguousDeltaChi2).
  struct Second {
    Vector3 normal;
    Vector3 ring_centre_m;
    double delta_chi2 = 0.0;
  };
  std::optional<Second> second;

  bool ambiguous() const { return second.has_value(); }
  /// Root of the mean squared angle between this normal and the true one, rad.
  double sigma_normal_rad() const;
};

/// Of chi2: from here on disagreement is not chance (1e-3 at two degrees of freedom, 1e-5 at twelve), and the
/// covariance is scaled.
inline constexpr double kChancePerFreedom = 3.5;

/// Poses of ring and nozzle from one to four ellipses: each cone's two circles, selected by two views, then least
/// squares over all ellipses with their own covariances.
///
/// Neither radii nor distance are known beforehand. The covariance is widened where the ellipses disagree by more than
/// their noise; where two mirrored tilts cannot be distinguished (a circle seen face on) it spans both. Cost: 50 us
/// with four ellipses.
Result<Ring2Estimate, Ring2Failure> solve_ring2(const Rig& rig, const ContourSet& contours);

}  // namespace pharos::ring2
