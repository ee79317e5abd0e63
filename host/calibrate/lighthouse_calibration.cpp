// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/lighthouse_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "host/calibrate/gather.hpp"
#include "host/calibrate/noise_level.hpp"
#include "host/calibrate/parameter_blocks.hpp"
#include "host/calibrate/start_pose.hpp"
#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

using host::InputError;

// Errors of nominal positions and stations: about 0.4 mm at 2 m in an angle, which a single pose does not explain.
constexpr double kNominalSigma_rad = 60.0 * kRadPerArcsec;
// After a first adjustment.
constexpr double kCalibratedSigma_rad = 10.0 * kRadPerArcsec;
// Difference from which on two poses count as distinct: that of a deliberate motion by hand.
constexpr double kElsewhere_m = 0.02;
constexpr double kElsewhere_rad = 5.0 * kRadPerDeg;
constexpr std::size_t kFewestPoses = 6;
constexpr double kContradiction = 5.0;
// Root mean square of the sensors' shifts over their priors from which on they are another body's: of thirty
// coordinates within their priors chance makes 1 +- 0.13.
constexpr double kOtherBody = 3.0;

class Calibration {
 public:
  explicit Calibration(LighthouseCalibrationInput input) : input_(std::move(input)) {
    require_sensors();
    Gathered gathered = gather(input_);
    intervals_ = std::move(gathered.intervals);
    result_.unknown_sensors = gathered.unknown_sensors;
    result_.form = input_.form;
    result_.scale_measured = !input_.lengths.empty();
    nominal_.target = input_.target;
    nominal_.station = std::move(gathered.stations);
  }

  LighthouseCalibration run() {
    start(nominal_.target, nominal_.station, kNominalSigma_rad);
    require_poses();
    require_length_ends();
    fits_.add_before(problem(), alone_);
    const BundleResult first = adjust(problem());
    refuse_other_body(first);
    refuse_contradiction(first);
    // Intervals solved as the mirror image, or ambiguous, are solved again with the calibrated parameters.
    intervals_ = all_intervals_;
    start(first.unknowns.target, first.unknowns.station, std::hypot(kCalibratedSigma_rad, unmodelled_of(first)));
    result_.bundle = settle();
    refuse_other_body(result_.bundle);
    refuse_contradiction(result_.bundle);
    fits_.add_after(intervals_, result_.bundle.residuals);
    result_.fits = fits_.table();
    result_.intervals = intervals_.size();
    result_.poses = distinct_poses();
    result_.unmodelled_rad = unmodelled_rad_;
    return std::move(result_);
  }

 private:
  void require_sensors() const {
    for (const MeasuredLength& length : input_.lengths) {
      for (const std::uint8_t sensor : {length.a, length.b}) {
        if (find_sensor(input_.target, sensor) != nullptr) continue;
        throw InputError(text_of(length) + ": the target has no sensor " + std::to_string(sensor) +
                         "; give two numbers of its table");
      }
    }
  }

  // A pose for every stationary interval and each station that sees it; keeps the intervals that have one.
  void start(const Target& target, const std::vector<lighthouse::StationCalibration>& stations, double sigma_rad) {
    if (all_intervals_.empty()) all_intervals_ = intervals_;
    std::vector<StationaryAverage> kept;
    std::vector<StationPoses> poses;
    result_.intervals_unsolved = 0;
    for (StationaryAverage& interval : intervals_) {
      StationPoses here;
      for (std::size_t s = 0; s < stations.size(); ++s) {
        const auto found = start_pose(interval, s, target, stations[s], input_.form, sigma_rad);
        if (found && !found->ambiguous) {
          here[s] = found->pose;
        } else {
          std::erase_if(interval.rotors, [s](const RotorView& view) { return view.station == s; });
        }
      }
      if (interval.rotors.empty()) {
        ++result_.intervals_unsolved;
        continue;
      }
      kept.push_back(std::move(interval));
      poses.push_back(here);
    }
    intervals_ = std::move(kept);
    tie_stations(poses);
    place(poses);
    alone_ = std::move(poses);
  }

  // The second station's pose: of the estimates of all intervals that both see, the one nearest to all others.
  void tie_stations(const std::vector<StationPoses>& poses) {
    nominal_.T_reference_station.assign(nominal_.station.size(), std::nullopt);
    nominal_.T_reference_station[0] = ReferenceFromStation{};
    std::vector<ReferenceFromStation> estimates;
    for (const StationPoses& here : poses) {
      if (here[0] && here[1]) estimates.push_back(*here[0] * here[1]->inverse());
    }
    double minimum = std::numeric_limits<double>::infinity();
    for (const ReferenceFromStation& candidate : estimates) {
      double sum = 0.0;
      for (const ReferenceFromStation& other : estimates) sum += pose_difference(candidate, other).norm();
      if (sum >= minimum) continue;
      minimum = sum;
      nominal_.T_reference_station[1] = candidate;
    }
  }

  void place(const std::vector<StationPoses>& poses) {
    home_.clear();
    nominal_.T_home_body.clear();
    for (const StationPoses& here : poses) {
      const bool tied = nominal_.station.size() > 1 && nominal_.T_reference_station[1].has_value();
      home_.push_back(here[0] || tied ? 0 : 1);
      if (here[home_.back()]) {
        nominal_.T_home_body.push_back(*here[home_.back()]);
      } else {
        nominal_.T_home_body.push_back(*nominal_.T_reference_station[1] * *here[1]);
      }
    }
  }

  std::size_t distinct_poses() const {
    std::vector<std::pair<std::size_t, LighthouseFromBody>> places;
    for (std::size_t i = 0; i < intervals_.size(); ++i) {
      const LighthouseFromBody& pose = nominal_.T_home_body[i];
      const bool known = std::any_of(places.begin(), places.end(), [&](const auto& place) {
        const Vector6 difference = pose_difference(pose, place.second);
        return place.first == home_[i] && difference.head<3>().norm() < kElsewhere_rad &&
               difference.tail<3>().norm() < kElsewhere_m;
      });
      if (!known) places.emplace_back(home_[i], pose);
    }
    return places.size();
  }

  void require_poses() const {
    const std::size_t poses = distinct_poses();
    const std::size_t moved_intervals = intervals_.size() + result_.intervals_unsolved;
    const std::string interval_count_text =
        std::to_string(moved_intervals) + (moved_intervals == 1 ? " rest" : " rests");
    if (poses == 0) {
      throw InputError("none of " + interval_count_text +
                       " gave a pose; is --target the table of this target? `pharos track` says why");
    }
    if (poses == 1) {
      throw InputError("the target never moved: " + interval_count_text +
                       " in one pose; record rests in at least six poses that differ in place and attitude");
    }
    if (poses < kFewestPoses) {
      throw InputError("too few poses: " + std::to_string(poses) + " of the needed " + std::to_string(kFewestPoses) +
                       " (" + interval_count_text + ", " + std::to_string(result_.intervals_unsolved) +
                       " without a sure pose); record more, differing in place and attitude");
    }
  }

  void require_length_ends() const {
    const ParameterBlocks blocks(problem());
    for (const MeasuredLength& length : input_.lengths) {
      for (const std::uint8_t sensor : {length.a, length.b}) {
        if (blocks.hit[index_in(input_.target, sensor)]) continue;
        throw InputError(text_of(length) + ": sensor " + std::to_string(sensor) +
                         " was never hit at rest; record poses that show it, or give another length");
      }
    }
  }

  BundleProblem problem() const {
    BundleProblem problem;
    problem.intervals = &intervals_;
    problem.home = home_;
    problem.nominal = nominal_;
    problem.sigmas = input_.sigmas;
    problem.lengths = input_.lengths;
    problem.form = input_.form;
    problem.unmodelled_rad = unmodelled_rad_;
    return problem;
  }

  // Adjusts, rejects bearings that fit no rigid body and estimates the unmodelled error, until neither changes.
  BundleResult settle() {
    constexpr int kMaxRounds = 6;
    for (int round = 0;; ++round) {
      BundleResult last = adjust(problem());
      if (round == kMaxRounds) return last;  // without the bearings rejected before
      const std::size_t rejected = reject_outliers(last.residuals, intervals_);
      const double level = unmodelled_level(last.residuals, unmodelled_rad_);
      const bool settled = rejected == 0 && std::abs(level - unmodelled_rad_) < 0.02 * level + 0.02 * kRadPerArcsec;
      result_.bearings_rejected += rejected;
      if (settled) return last;
      unmodelled_rad_ = level;
      nominal_.T_home_body = last.unknowns.T_home_body;
      nominal_.T_reference_station = last.unknowns.T_reference_station;
    }
  }

  double unmodelled_of(const BundleResult& bundle) const { return unmodelled_level(bundle.residuals, 0.0); }

  static std::string text_of(const MeasuredLength& length) {
    return "--length " + std::to_string(length.a) + "," + std::to_string(length.b);
  }

  void refuse_contradiction(const BundleResult& bundle) const {
    std::size_t worst = 0;
    for (std::size_t i = 1; i < bundle.lengths.size(); ++i) {
      if (bundle.lengths[i].sigmas_apart > bundle.lengths[worst].sigmas_apart) worst = i;
    }
    if (bundle.lengths.empty() || bundle.lengths[worst].sigmas_apart < kContradiction) return;
    const MeasuredLength& length = input_.lengths[worst];
    std::array<char, 256> text{};
    std::snprintf(
        text.data(), text.size(),
        ": %.3f mm contradicts all the rest by %.1f sigma (%.3f +- %.3f mm); measure again, or correct the target's "
        "table",
        length.length_m * kMmPerM, bundle.lengths[worst].sigmas_apart, bundle.lengths[worst].predicted_m * kMmPerM,
        bundle.lengths[worst].predicted_sigma_m * kMmPerM);
    throw InputError(text_of(length) + text.data());
  }

  // A table of another body is bent to this one where the recordings allow it: then its sensors move by many times
  // what was stated of them. One that is a little out of its place is what a calibration is for.
  void refuse_other_body(const BundleResult& bundle) const {
    double squares = 0.0, count = 0.0, worst_m = 0.0, prior_m = 0.0;
    std::uint8_t worst = 0;
    const Target& found = bundle.unknowns.target;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Vector3 shift = found[i].position_m - input_.target[i].position_m;
      if (shift.isZero(0.0)) continue;  // never hit
      squares += shift.squaredNorm() / (input_.sigmas.sensor_position_m * input_.sigmas.sensor_position_m);
      count += 3.0;
      if (shift.norm() <= worst_m) continue;
      worst_m = shift.norm();
      worst = found[i].sensor;
      prior_m = input_.sigmas.sensor_position_m;
    }
    if (squares <= kOtherBody * kOtherBody * count) return;
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(),
                  "not this target: sensor %d lies %.1f mm from where --target has it, known to %.2f mm; give the "
                  "table of the body that was recorded, or measure that sensor again",
                  int{worst}, worst_m * kMmPerM, prior_m * kMmPerM);
    throw InputError(text.data());
  }

  LighthouseCalibrationInput input_;
  std::vector<StationaryAverage> all_intervals_;  // with every candidate
  std::vector<StationaryAverage> intervals_;
  Homes home_;
  std::vector<StationPoses> alone_;  // by still
  Unknowns nominal_;
  double unmodelled_rad_ = 0.0;
  SensorFits fits_;
  LighthouseCalibration result_;
};

}  // namespace

LighthouseCalibration calibrate_lighthouse(LighthouseCalibrationInput input) {
  return Calibration(std::move(input)).run();
}

}  // namespace pharos::calibrate
