// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/calibration_store.hpp"

namespace pharos::tools {

/// What OOTX says of the stations of one recording: who stands in which slot, and which calibration holds.
class Stations {
 public:
  /// Takes a payload in; true when it changed the calibration in use of its station.
  bool push(const lighthouse::OotxPayload& payload);
  /// Calibration in use (came twice); null until there is one.
  const lighthouse::StationCalibration* calibration(std::uint8_t station) const { return store_.in_use(station); }
  /// The station's id: of the calibration in use, else of the last readable payload.
  std::optional<std::uint32_t> id(std::uint8_t station) const { return store_.named_id(station); }
  /// Every station was identified and calibrated.
  bool complete() const;
  /// For a tracker that goes on from here.
  const lighthouse::CalibrationStore& store() const { return store_; }

 private:
  lighthouse::CalibrationStore store_;
};

/// Reads a file's OOTX ahead, so that what it says holds from the first row: up to where every station is calibrated,
/// or to the end. Empty knowledge for what cannot be read twice.
Stations read_ahead(const std::string& path);

}  // namespace pharos::tools
