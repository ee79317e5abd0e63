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

/// A cycle's bearings as the solver takes them, and for each where it came from.
struct IdealObservations {
  pose::Observations observations;
  std::array<lighthouse::Bearing, pose::kMaxObservations> raw{};  // what each observation was made of
  /// Some bearing was corrected with a guess of its sensor's other angle (only one axis hit, or several candidates):
  /// worth correcting again once a pose is known.
  bool guessed = false;
  std::bitset<pose::kMaxObservations> by_guess;  // which
  /// Bearings that no direction ahead of the station can show.
  int left_out = 0;
};

/// Takes the station's errors out of a cycle's raw bearings.
///
/// The correction of one axis needs the direction across it: from `pose` where one is given, else from the same
/// sensor's other sweep, else from the middle of the other sweep. Bearings that no direction ahead can show are left
/// out. `calibration` null: raw bearings pass as ideal ones. `integers`: for cores without a floating-point unit, to
/// 2e-8 rad; a sensor with both its bearings then is not corrected by the pose, which tells nothing more of it, and how
/// far the first of these has moved since an older pose, so have the others.
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
