// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/motion/sweep_fit.hpp"

namespace pharos::motion {

/// Sensors of a sweep that must speak with one another before it is judged.
inline constexpr int kMinSensorsToJudge = 4;

/// The shift that all hits of a sweep have in common is more than a hand can have made of the prediction in `since_s`,
/// the time since the rotor's last sweep that was taken.
bool leaps(const SweepFit& fit, const StateEstimate& prediction, const SweepNoise& noise, double since_s);

/// That shift is improbable for the motion that is predicted: the body was pushed, or the sweep is wrong.
bool shift_is_improbable(const SweepFit& fit, const StateEstimate& prediction, const SweepNoise& noise);
/// That shift is large where the sweep was linearised. A hand that pushes a body turns it as well: linearised again at
/// the attitude that the hits show, little of the shift is left. Of hits that are all shifted alike it stays.
bool shifts_far(const SweepFit& fit);

/// Two hits and a third of them are foreign: they are not those of one body.
bool hits_disagree(const SweepFit& fit);

/// A dispute up to here does not interrupt a run of sweeps that nothing spoke against.
inline constexpr double kSomeDispute = 0.5;

/// How strongly a sweep that did not leap speaks against its target, 0 to 1, by what was left out of it. `withheld`: it
/// contradicted a quiet body; `nis`: by how much.
double dispute_of(const SweepFit& fit, bool withheld, double nis);

/// The leaps of one rotor's sweeps: a body that moved goes on, shifts that are wrong have nothing in common.
class Leaps {
 public:
  /// Whether a sweep that leapt goes on from the one before. `contradicted`: that one contradicted a shaken body and
  /// was taken.
  bool go_on(const SweepFit& fit, bool contradicted) const;
  void set(bool leapt, const SweepFit& fit) { shift_rad_ = leapt ? fit.shift_rad : 0.0; }
  double since_taken_s(std::int64_t time_ticks) const;
  void taken(std::int64_t time_ticks) { taken_ticks_ = time_ticks; }

 private:
  double shift_rad_ = 0.0;  // of the last sweep where it leapt and was withheld, else zero
  std::int64_t taken_ticks_ = INT64_MIN;
};

}  // namespace pharos::motion
