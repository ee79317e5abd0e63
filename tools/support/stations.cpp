// SPDX-License-Identifier: Apache-2.0
#include "tools/support/stations.hpp"

#include "pharos/lighthouse/ootx_fields.hpp"
#include "tools/support/recording.hpp"

namespace pharos::tools {

bool Stations::push(const lighthouse::OotxPayload& payload) {
  const auto fields = lighthouse::ootx_fields({payload.bytes.data(), payload.bytes.size()});
  if (fields && payload.station < kMaxStations && !first_id_[payload.station]) {
    first_id_[payload.station] = fields->calibration.id;
  }
  return store_.push(payload) == lighthouse::CalibrationStore::Verdict::kTakenIntoUse;
}

void Stations::forget() {
  store_.forget_stations();
  first_id_ = {};
}

const lighthouse::StationCalibration* Stations::calibration(std::uint8_t station) const {
  return store_.in_use(station);
}

std::optional<std::uint32_t> Stations::id(std::uint8_t station) const {
  if (const lighthouse::StationCalibration* in_use = store_.in_use(station)) return in_use->id;
  return station < kMaxStations ? first_id_[station] : std::nullopt;
}

bool Stations::complete() const {
  for (std::uint8_t station = 0; station < kMaxStations; ++station) {
    if (store_.in_use(station) == nullptr) return false;
  }
  return true;
}

Stations read_ahead(const std::string& path) {
  Stations stations;
  if (!is_rereadable(path)) return stations;
  Recording recording(path);
  while (!stations.complete()) {
    const std::optional<RecordingEvent> event = recording.next();
    if (!event) break;
    if (const auto* payload = std::get_if<lighthouse::OotxPayload>(&*event)) stations.push(*payload);
  }
  return stations;
}

}  // namespace pharos::tools
