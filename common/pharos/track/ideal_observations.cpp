// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/ideal_observations.hpp"

#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/fixed_station_model.hpp"
#include "pharos/lighthouse/station_model.hpp"

namespace pharos::track {
namespace {

using lighthouse::Bearing;
using lighthouse::ThetaPair;

Axis other_axis(Axis axis) { return axis == Axis::kX ? Axis::kY : Axis::kX; }

double middle_theta(const lighthouse::SweepBearings& bearings) {
  if (bearings.empty()) return kPi / 2;
  double sum = 0.0;
  for (const Bearing& bearing : bearings) sum += bearing.theta_rad;
  return sum / static_cast<double>(bearings.size());
}

// Corrects one cycle's bearings; selects the source of the angle across.
class Corrector {
 public:
  Corrector(const Cycle& cycle, const Target& target, const lighthouse::StationCalibration& calibration,
            lighthouse::ModelForm form, const LighthouseFromBody* pose, bool integers)
      : cycle_(cycle), target_(target), calibration_(calibration), form_(form), pose_(pose) {
    if (integers) fixed_.emplace(calibration, form);
    middle_[0] = middle_theta(cycle[Axis::kX]);
    middle_[1] = middle_theta(cycle[Axis::kY]);
  }

  std::optional<double> ideal(Axis axis, const Bearing& bearing) {
    const Axis across = other_axis(axis);
    const Bearing* partner = only_bearing(cycle_[across], bearing.sensor);
    const bool paired =
        bearing.sensor < kMaxSensors && partner != nullptr && only_bearing(cycle_[axis], bearing.sensor) != nullptr;
    guessed_ = !paired;
    const bool by_pose = pose_ != nullptr && !(fixed_ && paired);
    if (const SensorPlacement* sensor = by_pose ? find_sensor(target_, bearing.sensor) : nullptr) {
      const double predicted = lighthouse::ideal_thetas(*pose_ * sensor->position_m)[across];
      return fixed_ ? fixed_->ideal_from_raw(axis, bearing.theta_rad, predicted + moved()[across])
                    : lighthouse::ideal_from_raw(calibration_, form_, axis, bearing.theta_rad, predicted);
    }
    if (paired) {
      const auto pair = ideal_pair(axis, bearing, *partner);
      return pair ? std::optional<double>((*pair)[axis]) : std::nullopt;
    }
    const double partner_raw =
        partner != nullptr ? partner->theta_rad : middle_[static_cast<std::size_t>(index_of(across))];
    const auto pair = ideal_pair(ordered(axis, bearing.theta_rad, partner_raw));
    return pair ? std::optional<double>((*pair)[axis]) : std::nullopt;
  }

  /// Whether the last one was corrected with a guess.
  bool guessed() const { return guessed_; }

 private:
  // The sensor's bearing in this sweep when it has exactly one, else null.
  static const Bearing* only_bearing(const lighthouse::SweepBearings& bearings, std::uint8_t sensor) {
    const Bearing* found = nullptr;
    for (const Bearing& bearing : bearings) {
      if (bearing.sensor != sensor) continue;
      if (found != nullptr) return nullptr;
      found = &bearing;
    }
    return found;
  }

  static ThetaPair ordered(Axis axis, double theta_rad, double across_rad) {
    return axis == Axis::kX ? ThetaPair{theta_rad, across_rad} : ThetaPair{across_rad, theta_rad};
  }

  std::optional<ThetaPair> ideal_pair(const ThetaPair& raw) {
    return fixed_ ? fixed_->ideal_from_raw(raw) : lighthouse::ideal_from_raw(calibration_, form_, raw);
  }

  // Of a sensor with both bearings, stored for the other one.
  std::optional<ThetaPair> ideal_pair(Axis axis, const Bearing& bearing, const Bearing& partner) {
    std::optional<ThetaPair>& known = known_[bearing.sensor];
    if (!known) known = ideal_pair(ordered(axis, bearing.theta_rad, partner.theta_rad));
    return known;
  }

  // Offset of the first sensor with both bearings from its prediction by the pose.
  const ThetaPair& moved() {
    if (moved_) return *moved_;
    moved_ = ThetaPair{};
    for (const Bearing& bearing : cycle_[Axis::kX]) {
      const SensorPlacement* sensor = find_sensor(target_, bearing.sensor);
      const Bearing* partner = only_bearing(cycle_[Axis::kY], bearing.sensor);
      if (sensor == nullptr || bearing.sensor >= kMaxSensors || partner == nullptr) continue;
      if (only_bearing(cycle_[Axis::kX], bearing.sensor) == nullptr) continue;
      const auto pair = ideal_pair(Axis::kX, bearing, *partner);
      if (!pair) continue;
      const ThetaPair predicted = lighthouse::ideal_thetas(*pose_ * sensor->position_m);
      moved_ = ThetaPair{pair->x_rad - predicted.x_rad, pair->y_rad - predicted.y_rad};
      break;
    }
    return *moved_;
  }

  const Cycle& cycle_;
  const Target& target_;
  const lighthouse::StationCalibration& calibration_;
  lighthouse::ModelForm form_;
  const LighthouseFromBody* pose_;
  std::optional<lighthouse::FixedStationModel> fixed_;
  std::array<std::optional<ThetaPair>, kMaxSensors> known_;  // of sensors with both bearings
  std::optional<ThetaPair> moved_;
  std::array<double, kAxes> middle_{};
  bool guessed_ = false;
};

}  // namespace

void ideal_observations(const Cycle& cycle, const Target& target, const lighthouse::StationCalibration* calibration,
                        lighthouse::ModelForm form, const LighthouseFromBody* pose, bool integers,
                        IdealObservations& result) {
  const lighthouse::StationCalibration none;
  Corrector corrector(cycle, target, calibration != nullptr ? *calibration : none, form, pose, integers);
  result.observations.clear();
  result.by_guess.reset();
  result.left_out = 0;
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (const Bearing& bearing : cycle[axis]) {
      const std::optional<double> theta =
          calibration != nullptr ? corrector.ideal(axis, bearing) : std::optional<double>(bearing.theta_rad);
      if (!theta) {
        ++result.left_out;
        continue;
      }
      result.by_guess[result.observations.size()] = calibration != nullptr && corrector.guessed();
      result.raw[result.observations.size()] = bearing;
      result.observations.push_back({bearing.sensor, axis, *theta});
    }
  }
  result.guessed = result.by_guess.any();
}

double correct_guessed(const Cycle& cycle, const Target& target, const lighthouse::StationCalibration& calibration,
                       lighthouse::ModelForm form, const LighthouseFromBody& pose, IdealObservations& result) {
  Corrector corrector(cycle, target, calibration, form, &pose, true);
  double largest = 0.0;
  for (std::size_t k = 0; k < result.observations.size(); ++k) {
    if (!result.by_guess[k]) continue;
    double& theta_rad = result.observations[k].theta_rad;
    const std::optional<double> corrected = corrector.ideal(result.observations[k].axis, result.raw[k]);
    if (!corrected) continue;
    largest = std::fmax(largest, std::fabs(*corrected - theta_rad));
    theta_rad = *corrected;
  }
  return largest;
}

}  // namespace pharos::track
