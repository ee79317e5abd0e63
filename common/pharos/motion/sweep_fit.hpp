// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/motion/imm_filter.hpp"
#include "pharos/motion/sweep_information.hpp"

namespace pharos::motion {

/// Noise of one sweep's bearings, rad.
struct SweepNoise {
  double own_rad = 0.0;     // of each hit alone
  double common_rad = 0.0;  // of rotor and flash: the same for all hits of one sweep
};

/// Model of one station's angles.
struct StationView {
  const Target* target = nullptr;
  const lighthouse::StationCalibration* calibration = nullptr;  // null: angles as the ideal station's
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
};

/// One hit relative to a state estimate.
struct HitFit {
  HitFit() {}  // sets nothing: a vector has all of its elements made, and one that is used is set by what makes it
  Vector6 jacobian;      // of its bearing by the pose error
  Vector3 point_m;       // where the sensor is held to be, lighthouse frame
  double residual_rad;   // measured - predicted
  double ideal_rad;      // measured, the station's errors taken out
  double variance;       // own, rad^2
  std::uint8_t bearing;  // index in the sweep
};

/// Copies the hits that it holds, few of what it has room for.
class HitFits : public StaticVector<HitFit, kMaxSensors> {
 public:
  HitFits() = default;
  // The base's copies all that it has room for.
  HitFits(const HitFits& other) : StaticVector() { *this = other; }  // NOLINT(bugprone-copy-constructor-init)
  HitFits& operator=(const HitFits& other) {
    resize(other.size());
    std::copy(other.begin(), other.end(), begin());
    return *this;
  }
  ~HitFits() = default;
};

/// The plane that fits the sensors of some hits best, lighthouse frame; of at least one.
struct SensorPlane {
  Vector3 centre_m = Vector3::Zero();  // where they are on average
  Vector3 normal = Vector3::Zero();
  bool holds_all = false;  // they are coplanar

  static SensorPlane of(const HitFits& hits);
};

/// A sweep's hits, linearised, at most one a sensor, and their joint information.
struct SweepFit {
  SweepInformation information;
  LighthouseFromBody pose;  // that it was linearised at
  int candidates = 0;       // hits of the target's sensors
  int sensors = 0;          // sensors that were hit
  int foreign = 0;          // of them left out, and further off than any sensor is from its place
  /// -2 ln of the densities of the hits' own noise: of hits used, ln of their variance; of sensors left out, that of a
  /// uniform outlier. Makes hypotheses of different noise comparable.
  double log_density = 0.0;
  HitFits used;
  /// What all hits have in common, those left out too: the median residual, and the derivative of their mean bearing.
  double shift_rad = 0.0;
  Vector6 shift_jacobian = Vector6::Zero();
};

/// -2 ln of the density of a hit that was left out: it may lie anywhere within 20 mrad or so, 2 ln(0.02) - ln(2 pi).
inline constexpr double kStrayLogDensity = -9.7;

/// Standard deviations beyond which a hit does not belong to this body.
inline constexpr double kHitGate = 5.0;

/// Linearises every hit at its own instant against a state estimate that holds at `time_ticks`, and selects.
///
/// Of a sensor's candidates the one is taken whose residual is nearest to the median residual of the sweep: what all
/// have in common (an unforeseen shift, the flash's jitter) must not decide. Left out is what departs from that median
/// by more than the state's covariance and the noise allow, and then, one by one, what a common pose cannot explain.
SweepFit fit_sweep(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                   const StateEstimate& state_estimate, std::int64_t time_ticks, const SweepNoise& noise);

/// Sigma of the attitude (root of the trace, rad) to which one cycle of four coplanar sensors seen from straight ahead
/// tells their tilt alone: how large it is, not to which side.
inline constexpr double kTiltAlone_rad = 0.03;

/// Of hits of coplanar sensors, in `plane`: adds to their noise that of the bearings' second order in an attitude error
/// with this covariance (after the sweep), and sums anew. Coplanar sensors seen from straight ahead show a tilt mainly
/// in its square: linearised at an estimate that is off they seem to show it, sweep after sweep with the same error.
/// That part stretches and shears the pattern of the hits; to which side they are tilted shows in its perspective, and
/// stays as certain as it was.
void count_second_order(SweepFit& fit, const SensorPlane& plane, const Matrix3& attitude_covariance,
                        const SweepNoise& noise);

/// What the hits of coplanar sensors tell by perspective alone: any shift, stretch and shear of their pattern is taken
/// for noise. `systematic_rad`: error of each that is the same for kSameErrorSweeps.
SweepInformation perspective_of(const SweepFit& fit, const SensorPlane& plane, double systematic_rad);

}  // namespace pharos::motion
