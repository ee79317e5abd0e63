// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/motion/station_relative.hpp"

namespace pharos::tracking {

/// A station that a file describes: by id as its OOTX says, by slot position whatever its id, or both.
struct KnownStation {
  std::optional<std::uint32_t> id;
  std::optional<std::uint8_t> slot;
  lighthouse::StationCalibration calibration;  // its id is `id`, 0 where the file gives none
};

/// How two stations stand to one another: T_reference_station and the covariance of its error (Pose::moved_by).
struct CalibratedPair {
  std::uint32_t reference = 0, station = 0;  // their ids
  motion::StationFromStation T_reference_station;
  Matrix6 covariance = Matrix6::Zero();
};

/// Where the second slot's station stands in the frame of the first slot's, if the pair is these two.
std::optional<motion::StationRelative> relative_pose(const CalibratedPair& pair, std::uint32_t first_id,
                                                     std::uint32_t second_id);

/// What is known of stations before they send anything: what a calibration file says. Only views.
struct StationSurvey {
  std::span<const KnownStation> stations;
  const CalibratedPair* pair = nullptr;  // null: nobody measured how they stand

  /// The calibration for this slot position, else the one for this id; null where neither is known.
  const lighthouse::StationCalibration* find(std::uint8_t slot, const std::optional<std::uint32_t>& id) const {
    for (const KnownStation& station : stations) {
      if (station.slot == slot) return &station.calibration;
    }
    for (const KnownStation& station : stations) {
      if (!station.slot && id && station.id == id) return &station.calibration;
    }
    return nullptr;
  }
  /// How the stations of these ids stand, as relative_pose(); empty where an id or the pair is not known.
  std::optional<motion::StationRelative> relative(const std::optional<std::uint32_t>& first_id,
                                                  const std::optional<std::uint32_t>& second_id) const;
};

}  // namespace pharos::tracking
