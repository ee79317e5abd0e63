// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/pose/observation.hpp"
#include "pharos/track/cycle.hpp"

namespace pharos::track {

/// A cycle's bearings as input of the solver, and the source of each.
struct IdealObservations {
  pose::Observations observations;
  std::array<lighthouse::Bearing, pose::kMaxObservations> raw{};  // the source of each observation
  /// Some bearing was corrected with a guess of its sensor's other angle (only one axis hit, or several candidates): to
  /// be corrected again once a pose is known.
  bool guessed = false;
  std::bitset<pose::kMaxObservations> by_guess;  // which
  /// Bearings that no direction ahead of the station can give.
  int left_out = 0;
};

/// Removes the station's errors from a cycle's raw bearings.
///
/// The correction of one axis needs the direction across it: from `pose` where one is given, else from the same
/// sensor's other sweep, else from the middle of the other sweep. Bearings that no direction ahead can give are left
/// out. `calibration` null: raw bearings pass as ideal ones. `integers`: for cores without a floating-point unit, to
/// 2e-8 rad; a sensor with both its bearings is then not corrected by the pose, which adds nothing, and the motion of
/// the first of these since an older pose is applied to the others.
void ideal_observations(const Cycle& cycle, const Target& target, const lighthouse::StationCalibration* calibration,
                        lighthouse::ModelForm form, const LighthouseFromBody* pose, bool integers,
                        IdealObservations& result);

/// Corrects the guessed ones again, by a pose of this cycle, in integers. The largest change, rad.
double correct_guessed(const Cycle& cycle, const Target& target, const lighthouse::StationCalibration& calibration,
                       lighthouse::ModelForm form, const LighthouseFromBody& pose, IdealObservations& result);

/// ideal_observations in double, as a value.
inline IdealObservations ideal_observations(const Cycle& cycle, const Target& target,
                                            const lighthouse::StationCalibration* calibration,
                                            lighthouse::ModelForm form, const LighthouseFromBody* pose) {
  IdealObservations result;
  ideal_observations(cycle, target, calibration, form, pose, false, result);
  return result;
}

}  // namespace pharos::track
