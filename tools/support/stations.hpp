// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/calibration_store.hpp"

namespace pharos::tools {

/// OOTX of the stations of one recording: the station in each slot, and its calibration in use.
class Stations {
 public:
  /// Adds a payload; true when it changed the calibration in use of its station.
  bool push(const lighthouse::OotxPayload& payload);
  /// Calibration in use (received twice); null until there is one.
  const lighthouse::StationCalibration* calibration(std::uint8_t station) const { return store_.in_use(station); }
  /// The station's id: of the calibration in use, else of the last readable payload.
  std::optional<std::uint32_t> id(std::uint8_t station) const { return store_.named_id(station); }
  /// Every station was identified and calibrated.
  bool complete() const;
  /// For a tracker that continues from here.
  const lighthouse::CalibrationStore& store() const { return store_; }

 private:
  lighthouse::CalibrationStore store_;
};

/// Reads a file's OOTX ahead, so that calibrations are valid from the first row: until every station is calibrated, or
/// to the end. Empty for an input that cannot be read twice.
Stations read_ahead(const std::string& path);

}  // namespace pharos::tools
