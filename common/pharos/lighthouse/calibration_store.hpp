// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::lighthouse {

/// The calibration that each station uses, and every one that was ever accepted.
///
/// A 32-bit CRC passes a false payload now and then, and a changed calibration moves every pose: so a payload is used
/// only when its id and calibration fields came twice in succession (acceleration and counters may differ), or when it
/// equals one accepted before (also in an earlier run: remember()). When the memory is full, the oldest accepted one
/// that is not in use is evicted.
class CalibrationStore {
 public:
  static constexpr std::size_t kMemory = 8;

  enum class Verdict : std::uint8_t {
    kUnreadable,  // no fields (see OotxError): nothing changed
    kFirstTime,   // waits for confirmation
    kUnchanged,   // the one in use
    kTakenIntoUse,
  };

  Verdict push(const OotxPayload& payload);
  /// Preloads a calibration that was accepted before. It is used only once its station sends the same.
  void remember(const StationCalibration& calibration);
  /// Clears which station is which (a new recording), not what was accepted.
  void forget_stations();

  /// Calibration in use for a station number; null before the first.
  const StationCalibration* in_use(std::uint8_t station) const;
  /// Who stands there: the id of the calibration in use, else of the newest payload that waits for its confirmation (a
  /// name that proves wrong is corrected by the next one); empty until there is one.
  std::optional<std::uint32_t> named_id(std::uint8_t station) const;
  /// Every calibration accepted, oldest first.
  std::span<const StationCalibration> accepted() const { return {accepted_.data(), accepted_.size()}; }

 private:
  struct Station {
    std::optional<StationCalibration> in_use;
    std::optional<StationCalibration> candidate;
  };
  bool is_remembered(const StationCalibration& calibration) const;
  bool is_in_use(std::uint32_t id) const;

  std::array<Station, kMaxStations> station_;
  StaticVector<StationCalibration, kMemory> accepted_;
};

}  // namespace pharos::lighthouse
