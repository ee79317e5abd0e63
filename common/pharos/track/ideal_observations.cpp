// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/ideal_observations.hpp"

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

// Corrects one cycle's bearings; knows what may stand for the angle across.
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
    const bool by_pose = pose_ != nullptr && !(fixed_ && paired);
    if (const SensorPlacement* sensor = by_pose ? find_sensor(target_, bearing.sensor) : nullptr) {
      const ThetaPair predicted = lighthouse::ideal_thetas(*pose_ * sensor->position_m);
      return lighthouse::ideal_from_raw(calibration_, form_, axis, bearing.theta_rad, predicted[across]);
    }
    if (!paired) guessed_ = true;
    if (paired && known_[bearing.sensor]) return (*known_[bearing.sensor])[axis];
    const double partner_raw =
        partner != nullptr ? partner->theta_rad : middle_[static_cast<std::size_t>(index_of(across))];
    const ThetaPair raw =
        axis == Axis::kX ? ThetaPair{bearing.theta_rad, partner_raw} : ThetaPair{partner_raw, bearing.theta_rad};
    const auto pair = fixed_ ? fixed_->ideal_from_raw(raw) : lighthouse::ideal_from_raw(calibration_, form_, raw);
    if (!pair) return std::nullopt;
    if (paired) known_[bearing.sensor] = pair;
    return (*pair)[axis];
  }

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

  const Cycle& cycle_;
  const Target& target_;
  const lighthouse::StationCalibration& calibration_;
  lighthouse::ModelForm form_;
  const LighthouseFromBody* pose_;
  std::optional<lighthouse::FixedStationModel> fixed_;
  std::array<std::optional<ThetaPair>, kMaxSensors> known_;  // of sensors with both bearings
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
  result.left_out = 0;
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (const Bearing& bearing : cycle[axis]) {
      const std::optional<double> theta =
          calibration != nullptr ? corrector.ideal(axis, bearing) : std::optional<double>(bearing.theta_rad);
      if (!theta) {
        ++result.left_out;
        continue;
      }
      result.raw[result.observations.size()] = bearing;
      result.observations.push_back({bearing.sensor, axis, *theta});
    }
  }
  result.guessed = corrector.guessed();
}

}  // namespace pharos::track
