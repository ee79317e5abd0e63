// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/calibration_store.hpp"

#include <algorithm>

#include "pharos/lighthouse/ootx_fields.hpp"

namespace pharos::lighthouse {

CalibrationStore::Verdict CalibrationStore::push(const OotxPayload& payload) {
  const auto fields = ootx_fields({payload.bytes.data(), payload.bytes.size()});
  if (!fields || payload.station >= kMaxStations) return Verdict::kUnreadable;
  Station& station = station_[payload.station];
  const StationCalibration& calibration = fields->calibration;
  if (station.in_use == calibration) {
    station.candidate.reset();
    return Verdict::kUnchanged;
  }
  if (!is_remembered(calibration) && station.candidate != calibration) {
    station.candidate = calibration;
    return Verdict::kFirstTime;
  }
  station.candidate.reset();
  station.in_use = calibration;
  remember(calibration);
  return Verdict::kTakenIntoUse;
}

void CalibrationStore::remember(const StationCalibration& calibration) {
  const auto same_id = [&](const StationCalibration& other) { return other.id == calibration.id; };
  StationCalibration* place = std::find_if(accepted_.begin(), accepted_.end(), same_id);
  if (place == accepted_.end() && accepted_.full()) {
    place = std::find_if(accepted_.begin(), accepted_.end(),
                         [&](const StationCalibration& other) { return !is_in_use(other.id); });
  }
  if (place != accepted_.end()) {
    std::move(place + 1, accepted_.end(), place);
    accepted_.pop_back();
  }
  accepted_.push_back(calibration);
}

void CalibrationStore::forget_stations() { station_ = {}; }

const StationCalibration* CalibrationStore::in_use(std::uint8_t station) const {
  return station < kMaxStations && station_[station].in_use ? &*station_[station].in_use : nullptr;
}

std::optional<std::uint32_t> CalibrationStore::named_id(std::uint8_t station) const {
  if (station >= kMaxStations) return std::nullopt;
  const Station& there = station_[station];
  if (there.in_use) return there.in_use->id;
  return there.candidate ? std::optional(there.candidate->id) : std::nullopt;
}

bool CalibrationStore::is_remembered(const StationCalibration& calibration) const {
  return std::find(accepted_.begin(), accepted_.end(), calibration) != accepted_.end();
}

bool CalibrationStore::is_in_use(std::uint32_t id) const {
  return std::any_of(station_.begin(), station_.end(),
                     [id](const Station& station) { return station.in_use && station.in_use->id == id; });
}

}  // namespace pharos::lighthouse
