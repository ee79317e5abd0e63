// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/motion/station_relative.hpp"

namespace pharos::tracking {

/// A station in a calibration file: identified by its OOTX id, by its slot whatever its id, or by both.
struct KnownStation {
  std::optional<std::uint32_t> id;
  std::optional<std::uint8_t> slot;
  lighthouse::StationCalibration calibration;  // its id is `id`, 0 if the file has none
};

/// Relative pose of two stations: T_reference_station and the covariance of its error (Pose::moved_by).
struct CalibratedPair {
  std::uint32_t reference = 0, station = 0;  // their ids
  motion::StationFromStation T_reference_station;
  Matrix6 covariance = Matrix6::Zero();
};

/// Pose of the second slot's station in the frame of the first slot's, if the pair consists of these two.
std::optional<motion::StationRelative> relative_pose(const CalibratedPair& pair, std::uint32_t first_id,
                                                     std::uint32_t second_id);

/// The stations' calibrations in a calibration file, known before the stations send anything. Views only.
struct StationSurvey {
  std::span<const KnownStation> stations;
  const CalibratedPair* pair = nullptr;  // null: the relative pose is unknown

  /// The calibration for this slot, otherwise the one for this id; null if neither is known.
  const lighthouse::StationCalibration* find(std::uint8_t slot, const std::optional<std::uint32_t>& id) const {
    for (const KnownStation& station : stations) {
      if (station.slot == slot) return &station.calibration;
    }
    for (const KnownStation& station : stations) {
      if (!station.slot && id && station.id == id) return &station.calibration;
    }
    return nullptr;
  }
  /// Relative pose of the stations with these ids, as relative_pose(); empty if an id or the pair is unknown.
  std::optional<motion::StationRelative> relative(const std::optional<std::uint32_t>& first_id,
                                                  const std::optional<std::uint32_t>& second_id) const;
};

}  // namespace pharos::tracking
