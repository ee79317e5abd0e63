// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/mounting/mounting_calibration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "host/calibrate/mounting/hand_eye_start.hpp"
#include "host/calibrate/mounting/mounting_adjustment.hpp"
#include "host/calibrate/mounting/noise_time.hpp"
#include "host/calibrate/mounting/slow_errors.hpp"
#include "host/calibrate/mounting/unobservable_directions.hpp"
#include "host/support/input_error.hpp"
#include "host/support/rounded_number.hpp"
#include "pharos/base/noise_correlation.hpp"
#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

using host::InputError;
using host::MountingOrigin;

constexpr double kVagueRotation_rad = 1.0, kVaguePosition_m = 5.0, kVagueTime_s = 1.0;
constexpr double kMinTurn_rad = 3.0 * kRadPerDeg;
// Translations across the first axis alone are told by the second axis: its lever arms are this small a fraction.
constexpr double kMinSecondTurn_rad = 2.0 * kRadPerDeg;
constexpr std::size_t kMinRows = 30;
constexpr double kMinSeconds = 5.0;
constexpr double kOutlierChi2 = 50.0;  // of six: 5e-9
constexpr int kRounds = 4;
// Nodes of the slow error a time constant, with straight lines between them: what changes faster than a target sways is
// lost, and its part that looks like a turned mounting would be in no sigma.
constexpr double kSlowSteps = 8.0;
// Nodes of a source: the evidence of four sources' is a dense matrix of 0.2 GB. Of more than 7 min they are farther
// apart.
constexpr double kMaxSlowNodes = 120.0;
constexpr std::size_t kMaxKnots = 2000;
// Of slam without a prior: a baseline of 0.3 m known to 0.6 mm. Without it slam would bend the motion of all sources.
constexpr double kSlamScaleSigma = 2e-3;

Matrix6 vague() {
  Vector6 variance;
  variance << Vector3::Constant(kVagueRotation_rad * kVagueRotation_rad),
      Vector3::Constant(kVaguePosition_m * kVaguePosition_m);
  return variance.asDiagonal();
}

UnknownPose unknown(const Matrix3& R, const Vector3& t) { return {R, t, {}}; }

std::vector<TimedTarget> reference_path(const MountingRecording& recording, const UnknownSource& source) {
  const host::VehicleFromSensor X{source.sensor.R, source.sensor.t};
  const host::TargetFromFeature Y{source.feature.R, source.feature.t};
  std::vector<TimedTarget> path;
  for (const host::SourceRow& row : recording.rows) {
    if (!row.has_turn || row.second) continue;
    const double time_s = row.time_s + source.time_offset_s;
    if (!path.empty() && !(time_s > path.back().time_s)) continue;
    path.push_back({time_s, X * row.pose * Y.inverse()});
  }
  return path;
}

UnknownSource given_source(const MountingCalibrationInput& input) {
  const MountingRecording& recording = input.recordings[input.given];
  UnknownSource source;
  source.fixed = true;
  if (recording.kind == host::SourceKind::kSlam || recording.kind == host::SourceKind::kRing2) {
    throw InputError(recording.name + ": " + std::string(word_of(recording.kind)) +
                     " cannot define the frames: give a source that measures the whole pose of a fixed feature");
  }
  const host::SourceMounting* prior = input.prior ? input.prior->find(recording.name) : nullptr;
  if (prior == nullptr) return source;
  const host::VehicleFromSensor X = prior->vehicle_from_sensor();
  source.sensor = unknown(X.R, X.t);
  if (const auto Y = prior->target_from_feature()) source.feature = unknown(Y->R, Y->t);
  source.time_offset_s = prior->time_offset_s;
  return source;
}

bool all_have_prior(const MountingCalibrationInput& input) {
  for (std::size_t s = 0; s < input.recordings.size(); ++s) {
    if (s == input.given) continue;
    if (!input.prior || input.prior->find(input.recordings[s].name) == nullptr) return false;
  }
  return true;
}

void check_motion(const MountingCalibrationInput& input, const std::vector<TimedTarget>& path, const Vector3& turn) {
  const std::string& name = input.recordings[input.given].name;
  if (path.size() < kMinRows || path.back().time_s - path.front().time_s < kMinSeconds) {
    throw InputError(name + ": fewer than 30 poses or less than 5 s; record a minute in which the target moves");
  }
  if (all_have_prior(input)) return;
  const auto degrees = [](double rad) { return host::rounded_number(rad * kDegPerRad, 1); };
  if (turn[0] < kMinTurn_rad) {
    throw InputError(name + ": the target does not turn (" + degrees(turn[0]) +
                     " deg RMS): turn it by 15 deg and more about two axes, or give --prior of every source");
  }
  if (turn[1] < kMinSecondTurn_rad) {
    throw InputError(name + ": the target turns about one axis only (" + degrees(turn[0]) + " deg RMS about it, " +
                     degrees(turn[1]) + " across): turn it about a second one, or give --prior of every source");
  }
}

UnknownSource other_source(const MountingCalibrationInput& input, std::size_t index,
                           const std::vector<TimedTarget>& path) {
  const MountingRecording& recording = input.recordings[index];
  const host::SourceMounting* prior = input.prior ? input.prior->find(recording.name) : nullptr;
  UnknownSource source;
  if (recording.kind == host::SourceKind::kSlam) source.scale_sigma = kSlamScaleSigma;
  const auto start = search_hand_eye_start(path, recording.rows, input.max_offset_s);
  if (!start && prior == nullptr) {
    throw InputError(recording.name + ": fewer than 10 poses at times of " + input.recordings[input.given].name +
                     ", or a motion that does not tell its mounting; record more motion, or give --prior");
  }
  if (start) {
    source.sensor = unknown(start->T_vehicle_sensor.R, start->T_vehicle_sensor.t);
    source.feature = unknown(start->T_target_feature.R, start->T_target_feature.t);
    source.time_offset_s = start->time_offset_s;
  }
  source.prior_sensor = source.sensor;
  source.prior_feature = source.feature;
  source.prior_sensor_covariance = source.prior_feature_covariance = vague();
  source.prior_offset_s = source.time_offset_s;
  source.prior_offset_sigma_s = kVagueTime_s;
  if (prior == nullptr) return source;
  if (prior->scale_sigma > 0.0) source.scale_sigma = prior->scale_sigma;
  const host::VehicleFromSensor X = prior->vehicle_from_sensor();
  source.prior_sensor = unknown(X.R, X.t);
  source.prior_sensor_covariance = prior->T_vehicle_sensor.covariance;
  const auto Y = prior->target_from_feature();
  if (Y) {
    source.prior_feature = unknown(Y->R, Y->t);
    source.prior_feature_covariance = prior->T_target_feature->covariance;
  }
  source.prior_offset_s = prior->time_offset_s;
  source.prior_offset_sigma_s = std::max(prior->time_offset_sigma_s, 1e-9);
  if (!start) {
    source.sensor = source.prior_sensor;
    source.feature = source.prior_feature;
    source.time_offset_s = source.prior_offset_s;
    if (Y) return source;
    // Where the feature is at the first common pose; turned as the source sees it.
    for (const host::SourceRow& row : recording.rows) {
      const auto target = target_at(path, row.time_s + source.time_offset_s, kMaxPathGap_s);
      if (!target) continue;
      const auto T = target->inverse() * X * row.pose;
      source.feature = source.prior_feature = unknown(T.R, T.t);
      return source;
    }
    throw InputError(recording.name + ": no poses at times of " + input.recordings[input.given].name);
  }
  return source;
}

void start_motion(const std::vector<TimedTarget>& path, double knot_s, MountingUnknowns& unknowns) {
  unknowns.begin_s = path.front().time_s;
  const double span_s = path.back().time_s - unknowns.begin_s;
  if (span_s / knot_s > static_cast<double>(kMaxKnots)) {
    throw InputError("the recording is longer than " + host::rounded_number(knot_s * kMaxKnots, 0) +
                     " s; a minute or two tells the mounting");
  }
  const auto segments = static_cast<std::size_t>(std::ceil(span_s / knot_s));
  unknowns.knot_s = span_s / static_cast<double>(segments);
  for (std::size_t i = 0; i < segments + 3; ++i) {
    const double time_s = unknowns.begin_s + (static_cast<double>(i) - 1.0) * unknowns.knot_s;
    const double within = std::clamp(time_s, path.front().time_s, path.back().time_s - 1e-9);
    const host::VehicleFromTarget pose = target_at(path, within, 1e9).value_or(path.back().pose);
    unknowns.motion.push_back(unknown(pose.R, pose.t));
  }
}

void start_slow(const MountingCalibrationInput& input, MountingUnknowns& unknowns) {
  const double span_s = static_cast<double>(unknowns.segments()) * unknowns.knot_s;
  unknowns.slow_step_s = std::max(input.slow_time_constant_s / kSlowSteps, span_s / kMaxSlowNodes);
  const auto nodes = static_cast<std::size_t>(span_s / unknowns.slow_step_s) + 2;
  for (UnknownSource& source : unknowns.sources) source.slow.assign(nodes, {});
}

// Rows at times at which the given source was seen, and unambiguous.
std::vector<std::vector<bool>> usable_rows(const MountingCalibrationInput& input, const MountingUnknowns& unknowns,
                                           const std::vector<TimedTarget>& path, std::vector<MountingFit>& fits) {
  std::vector<std::vector<bool>> usable;
  for (std::size_t s = 0; s < input.recordings.size(); ++s) {
    std::vector<bool> of_source;
    for (const host::SourceRow& row : input.recordings[s].rows) {
      const double time_s = row.time_s + unknowns.sources[s].time_offset_s;
      const bool inside = s == input.given || target_at(path, time_s, kMaxPathGap_s).has_value();
      fits[s].ambiguous += row.second ? 1U : 0U;
      fits[s].outside += !row.second && !inside ? 1U : 0U;
      of_source.push_back(inside && !row.second);
    }
    if (std::count(of_source.begin(), of_source.end(), true) < static_cast<std::ptrdiff_t>(kMinRows / 3)) {
      throw InputError(input.recordings[s].name + ": fewer than 10 poses at times of " +
                       input.recordings[input.given].name + "; are the clocks the same, within --max-offset-s?");
    }
    usable.push_back(of_source);
  }
  return usable;
}

// Median of chi-squared over that of six degrees of freedom, at least 1: covariances may be stated too small.
double robust_scale(std::vector<double> chi2) {
  constexpr double kMedianOfSix = 5.35;
  if (chi2.empty()) return 1.0;
  const auto middle = chi2.begin() + static_cast<std::ptrdiff_t>(chi2.size() / 2);
  std::nth_element(chi2.begin(), middle, chi2.end());
  return std::max(*middle / kMedianOfSix, 1.0);
}

// Residuals of one source's rows; those far outside of the others are outliers.
void assess_source(const MountingRecording& recording,
                   const std::vector<std::pair<std::size_t, RowResidual>>& residuals, std::vector<bool>& inliers,
                   MountingFit& fit) {
  std::vector<double> chi2;
  for (const auto& [row, residual] : residuals) chi2.push_back(residual.chi2);
  const double gate = kOutlierChi2 * robust_scale(chi2);
  fit.residuals.clear();
  fit.used = fit.outliers = 0;
  double rotation = 0.0, position = 0.0, sum = 0.0;
  for (const auto& [row, r] : residuals) {
    const bool used = r.chi2 <= gate;
    inliers[row] = used;
    const Matrix6& stated = recording.rows[row].covariance;
    fit.residuals.push_back({r.time_s, r.rotation_rad, r.position_m, stated.topLeftCorner<3, 3>().trace(),
                             stated.bottomRightCorner<3, 3>().trace(), used});
    ++(used ? fit.used : fit.outliers);
    if (!used) continue;
    rotation += r.rotation_rad.squaredNorm();
    position += r.position_m.squaredNorm();
    sum += r.chi2 / (recording.rows[row].has_turn ? 6.0 : 5.0);
  }
  if (fit.used < kMinRows / 3) {
    throw InputError(recording.name + ": " + std::to_string(fit.used) +
                     " poses fit one mounting; is it the table of this source, at the same times?");
  }
  const auto n = static_cast<double>(fit.used);
  fit.rms_rotation_rad = std::sqrt(rotation / n);
  fit.rms_position_m = std::sqrt(position / n);
  fit.chi2_per_freedom = sum / n;
}

// How many poses are worth one, where their noise is alike for `time_s`: each weighs by its own step from the one
// before.
double poses_of_one(const std::vector<MountingResidual>& poses, double time_s) {
  double weight = 1.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    weight += 1.0 / noise_correlation(time_s, poses[i].time_s - poses[i - 1].time_s);
  }
  return static_cast<double>(poses.size()) / weight;
}

// Residuals of all rows; marks outliers, and enlarges covariances that are too small for the residuals, or for as many
// rows as there are.
void assess(const MountingCalibrationInput& input, const MountingUnknowns& unknowns,
            const std::vector<std::vector<bool>>& usable, std::vector<std::vector<bool>>& inliers,
            std::vector<double>& enlarged, std::vector<MountingFit>& fits) {
  std::vector<std::vector<std::pair<std::size_t, RowResidual>>> residuals(fits.size());
  for (const UsedRow& row : select_rows(input, unknowns, usable)) {
    residuals[row.source].emplace_back(row.row, residual_of(input, row, unknowns));
  }
  inliers = usable;
  for (std::size_t s = 0; s < fits.size(); ++s) {
    assess_source(input.recordings[s], residuals[s], inliers[s], fits[s]);
    enlarged[s] = std::max(fits[s].chi2_per_freedom, 1.0);
    enlarged[s] *= poses_of_one(fits[s].residuals, noise_time_s(fits[s], unknowns.knot_s));
  }
}

template <class PoseType>
host::MountingPose estimated(const UnknownPose& pose, const Matrix6& covariance) {
  host::MountingPose out;
  out.origin = MountingOrigin::kEstimated;
  out.covariance = covariance;
  out.set(PoseType{pose.R, pose.t});
  return out;
}

host::SourceMounting mounting_of(const MountingCalibrationInput& input, std::size_t index, const UnknownSource& source,
                                 const SourceCovariance& covariance) {
  host::SourceMounting out;
  out.name = input.recordings[index].name;
  out.kind = input.recordings[index].kind;
  out.scale_sigma = source.scale_sigma;
  out.time_offset_s = source.time_offset_s;
  const host::VehicleFromSensor X{source.sensor.R, source.sensor.t};
  const host::TargetFromFeature Y{source.feature.R, source.feature.t};
  if (source.fixed) {
    out.T_vehicle_sensor.origin = out.time_offset_origin = MountingOrigin::kGiven;
    out.T_vehicle_sensor.set(X);
    out.T_target_feature = out.T_vehicle_sensor;
    out.T_target_feature->set(Y);
    return out;
  }
  out.T_vehicle_sensor = estimated<host::VehicleFromSensor>(source.sensor, covariance.block<6, 6>(0, 0));
  out.T_target_feature = estimated<host::TargetFromFeature>(source.feature, covariance.block<6, 6>(6, 6));
  out.cross_covariance = covariance.block<6, 6>(0, 6);
  out.time_offset_sigma_s = std::sqrt(covariance(12, 12));
  out.time_offset_origin = MountingOrigin::kEstimated;
  out.unobservable = unobservable_directions(source, covariance);
  return out;
}

// Half way, as ratios, from what was assumed to what the recording tells: a minute holds two time constants, and an
// estimate that happens to be small must not make a mounting look sure.
MountingCalibrationInput half_way(const MountingCalibrationInput& assumed, MountingCalibrationInput estimated) {
  for (std::size_t s = 0; s < estimated.recordings.size(); ++s) {
    const MountingRecording& from = assumed.recordings[s];
    MountingRecording& to = estimated.recordings[s];
    to.slow_rotation_rad = std::sqrt(to.slow_rotation_rad * from.slow_rotation_rad);
    to.slow_position_m = std::sqrt(to.slow_position_m * from.slow_position_m);
  }
  return estimated;
}

}  // namespace

MountingCalibration calibrate_mounting(const MountingCalibrationInput& input) {
  if (input.recordings.size() < 2)
    throw InputError("one source alone has nothing to be compared with; give two or more");
  MountingUnknowns unknowns;
  unknowns.sources.resize(input.recordings.size());
  unknowns.sources[input.given] = given_source(input);
  const std::vector<TimedTarget> path = reference_path(input.recordings[input.given], unknowns.sources[input.given]);
  MountingCalibration out;
  out.turn_rad = excitation_rad(path);
  check_motion(input, path, out.turn_rad);
  for (std::size_t s = 0; s < input.recordings.size(); ++s) {
    if (s != input.given) unknowns.sources[s] = other_source(input, s, path);
  }
  start_motion(path, input.knot_spacing_s, unknowns);
  start_slow(input, unknowns);
  out.seconds = path.back().time_s - path.front().time_s;
  out.fits.resize(input.recordings.size());
  const auto usable = usable_rows(input, unknowns, path, out.fits);
  std::vector<std::vector<bool>> inliers = usable;
  std::vector<double> enlarged(input.recordings.size(), 1.0);
  const auto settle = [&](const MountingCalibrationInput& assumed, int rounds) {
    for (int round = 0; round < rounds; ++round) {
      out.converged = adjust(assumed, select_rows(assumed, unknowns, inliers), enlarged, unknowns);
      assess(assumed, unknowns, usable, inliers, enlarged, out.fits);
    }
  };
  settle(input, kRounds);
  const MountingCalibrationInput estimated =
      with_estimated_slow_errors(input, select_rows(input, unknowns, inliers), enlarged, unknowns);
  const MountingCalibrationInput likely = half_way(input, estimated);
  settle(likely, 1);
  const std::vector<UsedRow> rows = select_rows(input, unknowns, inliers);
  const auto covariance = covariances(likely, rows, enlarged, unknowns);
  const std::vector<SourceErrors> errors = source_errors(estimated, rows, unknowns, out.fits);
  for (std::size_t s = 0; s < input.recordings.size(); ++s) {
    out.mounting.sources.push_back(mounting_of(input, s, unknowns.sources[s], covariance[s]));
    out.mounting.sources.back().noise_time_s = errors[s].noise_time_s;
    out.mounting.sources.back().slow_error = errors[s].slow;
  }
  return out;
}

}  // namespace pharos::calibrate
