// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "pharos/lighthouse/bearing.hpp"
#include "pharos/motion/cycle_information.hpp"
#include "pharos/motion/imm_filter.hpp"
#include "pharos/motion/plausibility.hpp"
#include "pharos/motion/sweep_fit.hpp"
#include "pharos/motion/tilt.hpp"
#include "pharos/track/cycle.hpp"

namespace pharos::motion {

/// Errors that are the same from sweep to sweep, 1 sigma: no residual shows all of them and averaging does not reduce
/// them.
struct SystematicErrors {
  double sensor_position_m = 0.0;  // of each sensor, per axis
  double rotor_rad = 0.0;          // of each rotor, the same for all its hits: phase above all
};

/// Of a target built from its drawing and a station known from its OOTX alone: 0.4 mm; phase 0.5 mrad, tilt and curve
/// 0.3 mrad each.
inline constexpr SystematicErrors kUncalibratedErrors{0.4e-3, 0.6e-3};
/// What a calibration from thirty poses and one length leaves of them, where the calibration does not state it itself.
inline constexpr SystematicErrors kCalibratedErrors{0.002e-3, 0.07e-3};

/// Noise of one bearing as assumed: its standard deviation (rad) and the correlation between sensors of one sweep; and
/// the systematic errors.
struct AssumedNoise {
  double sigma_rad = 0.0;
  double rho = 0.0;
  SystematicErrors systematic;
};

/// Own noise beyond this many times the assumed one is not noise alone.
inline constexpr double kNoisy = 3.0;

/// One hypothesis of the body's motion: an IMM filter that takes sweep after sweep, its likelihood, and the estimated
/// noise of single hits.
class Hypothesis {
 public:
  /// From a single-cycle solution and that cycle's sweeps. The solution serves as the linearisation point only: its
  /// hits are processed again, each at its own instant, twice. `noise_scale`: own noise over the assumed one, as a
  /// first guess; must be given where the assumed noise is far too small (uncalibrated target or station). `rate`:
  /// where one is roughly known, else null.
  Hypothesis(const track::Cycle& cycle, const LighthouseFromBody& pose, const Vector6* rate, double noise_scale,
             const StationView& view, const AssumedNoise& noise);

  /// Predicts to the sweep's time and adds it. A sweep none of whose hits fits changes nothing but the time.
  /// `observer`: whose sweep; the second station's only once linked. `without`: where given, becomes this hypothesis
  /// without the sweep if a steady body's was taken and is doubtful: the body was pushed, or the sweep is wrong.
  const SweepFit& push(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                       const AssumedNoise& noise, Observer observer = Observer::kReference,
                       std::optional<Hypothesis>* without = nullptr);
  /// From here on sweeps of a second station count too (ImmFilter::link). `surveyed`: its pose was measured, so its
  /// covariance does not grow with time.
  void link(const StationFromStation& T_second_reference, const Matrix6& covariance, bool surveyed);

  const ImmFilter& filter() const { return filter_; }
  /// Whose the last sweep was.
  Observer observer() const { return observer_; }
  /// The state estimate after the last sweep, at time_ticks(), in the frame of that sweep's station; systematic errors
  /// included.
  const StateEstimate& state_estimate() const { return state_estimate_; }
  const CycleInformation& cycle_information(Observer observer = Observer::kReference) const {
    return station_state(observer).view;
  }
  /// State estimate at any time, predicted from the present one; up to kLost_s ahead.
  StateEstimate predicted(std::int64_t time_ticks, Observer observer = Observer::kReference) const;
  std::int64_t time_ticks() const { return time_ticks_; }
  std::int64_t last_used_ticks() const { return last_used_ticks_; }
  const SweepFit& last_fit() const { return fit_; }
  /// NIS: chi-squared of the last sweep's innovation; its degrees of freedom are the rank of last_fit().
  double nis() const { return nis_; }
  /// The innovation exceeds the gate of every model: the filter has diverged and reports no pose.
  bool diverged() const { return diverged_; }
  /// -2 ln of the likelihood of all sweeps since reset_cost().
  double cost() const { return cost_; }
  void reset_cost() { cost_ = 0.0; }
  int sweeps() const { return sweeps_; }
  /// A sweep of each rotor was fitted since it began, or since it diverged.
  bool confirmed() const { return confirmed_; }
  /// Sweeps in a row that agreed: with the prediction, and not by way of new rates.
  int agreements() const { return agreements_; }
  /// The last sweep contradicted a quiet body, or no body can have made it; it was left out.
  bool withheld() const { return withheld_; }
  /// How strongly the last sweep speaks against the target, 0 to 1: no body moved so, or its hits are not of one body.
  double dispute() const { return dispute_; }
  /// Sweeps since it began, or since one spoke strongly against the target; negative where its state is in doubt.
  int undisputed() const { return undisputed_; }
  /// Takes the smaller count of undisputed sweeps, its own or that of the hypothesis it replaces.
  void inherit_disputes(const Hypothesis& other) { undisputed_ = std::min(undisputed_, other.undisputed_); }
  /// It takes over from one that withheld what it took: its state is in doubt.
  void confirm_anew();
  /// The last sweep was of coplanar sensors, and to which side they are tilted is not known yet: the attitude is no
  /// better than one cycle tells it, and mirrored it may fit as well.
  bool tilt_unknown() const { return tilt_unknown_; }
  /// The last sweep was of coplanar sensors.
  bool sees_tilt() const { return tilt_.has_value(); }
  /// Where it was: sigmas between this attitude and the one tilted to the other side.
  double mirrored_apart() const;
  /// It was, and their tilt is known so little that the bearings' second order in its error counts.
  bool tilt_is_loose() const;
  /// What the state estimate's covariance lacks where it was, and their tilt is not known well.
  Matrix6 second_order() const;
  /// Whether a pose is nearer to this attitude than to the one tilted to the other side.
  bool is_nearer_than_mirrored(const LighthouseFromBody& pose) const;
  /// The same with the sensors tilted to the other side, as after that sweep.
  Hypothesis mirrored() const;
  /// A sweep of each rotor was of sensors with relief.
  bool sees_relief() const { return sweeps_with_relief_ >= kOneOfEachRotor; }
  /// -2 ln of the likelihood of the last sweep, as far as it tells the side of the tilt.
  double side_cost(const AssumedNoise& noise) const;
  /// Consecutive sweeps most of whose hits were rejected.
  int consecutive_rejections() const { return consecutive_rejections_; }
  /// Own noise over the assumed one, as estimated.
  double noise_scale(Observer observer = Observer::kReference) const;
  /// It is as large as is ever believed: not noise, nor what sensors are out of their places.
  bool noise_implausible() const;

 private:
  // What one station's sweeps show beyond the body's motion.
  struct StationState {
    CycleInformation view;
    Matrix6 systematic = Matrix6::Zero();  // of the pose it sees, from errors that do not average out
    std::int64_t seen_ticks = INT64_MIN;
    std::array<bool, kAxes> contradicted{};  // the last sweep of each rotor
    std::array<Leaps, kAxes> leaps;          // of each rotor
    double level = 1.0;                      // own variance over the assumed one
    double noise_degrees_of_freedom = 0.0;   // that it was estimated from
  };

  // A body that is pushed after so many sweeps is not one that has just been found.
  static constexpr int kSettled = 16;
  // Sweeps in a row that confirm a state, or by their relief tell the side of the tilt: one of each rotor.
  static constexpr int kOneOfEachRotor = 2;
  // Range of the estimated own variance over the assumed one.
  static constexpr double kMinLevel = 0.8, kMaxLevel = 1e4;
  // What a sweep says beyond how it fits.
  struct Objections {
    bool leapt = false;     // no body moves so
    bool of_state = false;  // the state may be that of wrong sweeps before
    bool pushed = false;    // a quiet body was
  };

  Hypothesis() = default;
  StationState& station_state(Observer observer) { return station_states_[static_cast<std::size_t>(observer)]; }
  const StationState& station_state(Observer observer) const {
    return station_states_[static_cast<std::size_t>(observer)];
  }
  Matrix6 systematic_covariance(const StationState& station_state, double range_m, const AssumedNoise& noise) const;
  void leave_out();
  void judge_tilt(bool both_sides_followed);
  void see_tilt();
  void dispute(const Objections& objections);
  void follow(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
              const StateEstimate& prediction, const SweepNoise& now, Innovation innovation);
  Matrix3 attitude_after(const Matrix6& known, const Vector6& offset) const;
  void learn_noise(StationState& station_state, const CycleInformation::ResidualChi2& cycle) const;
  void inflate_relative_covariance(double dt_s);
  Matrix6 systematic_of(Observer observer) const;
  StateEstimate with_systematics(const ImmFilter& filter, Observer observer) const {
    StateEstimate state_estimate = filter.state_estimate(observer);
    add_systematics(state_estimate, observer);
    return state_estimate;
  }
  void add_systematics(StateEstimate& state_estimate, Observer observer) const;

  ImmFilter filter_;
  StateEstimate state_estimate_;
  Observer observer_ = Observer::kReference;  // of the last sweep
  SweepFit fit_;
  SensorPlane plane_;                               // of the sensors that it used
  Matrix6 predicted_covariance_ = Matrix6::Zero();  // of the pose before it
  Vector6 predicted_offset_ = Vector6::Zero();      // of that pose from the one linearised at
  std::array<StationState, 2> station_states_;
  bool surveyed_ = false;
  std::int64_t time_ticks_ = 0;
  std::int64_t last_used_ticks_ = 0;
  double cost_ = 0.0;
  double nis_ = 0.0;
  int sweeps_ = 0;
  int agreements_ = 0, fitted_ = 0, undisputed_ = 0;
  bool confirmed_ = false;
  int consecutive_rejections_ = 0;
  bool rates_reset_ = false;
  bool withheld_ = false;
  bool coplanar_ = false;  // the last sweep's sensors, where their tilt is not known well
  bool side_doubtful_ = false, tilt_unknown_ = false;
  int sweeps_of_relief_ = 0;    // in a row
  std::optional<Tilt> tilt_;    // after the last sweep
  int sweeps_with_relief_ = 0;  // in a row, whether steady or not
  double dispute_ = 0.0;
  bool contradicted_ = false;  // by the last sweep
  bool diverged_ = false;
};

/// Two hypotheses that met: what the better one states holds both.
bool same_pose(const Hypothesis& best, const Hypothesis& alternative);

/// Time of the last hit of the target's sensors; INT64_MIN where there is none.
std::int64_t last_hit_ticks(const lighthouse::SweepBearings& bearings, const Target& target);

}  // namespace pharos::motion
