// SPDX-License-Identifier: Apache-2.0
#include "tools/support/stations.hpp"

#include "tools/support/recording.hpp"

namespace pharos::tools {

bool Stations::push(const lighthouse::OotxPayload& payload) {
  return store_.push(payload) == lighthouse::CalibrationStore::Verdict::kTakenIntoUse;
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
