// SPDX-License-Identifier: Apache-2.0
#include "pharos/tracking/station_survey.hpp"

namespace pharos::tracking {

std::optional<motion::StationRelative> relative_pose(const CalibratedPair& pair, std::uint32_t first_id,
                                                     std::uint32_t second_id) {
  const motion::StationRelative relative{pair.T_reference_station, pair.covariance};
  if (pair.reference == first_id && pair.station == second_id) return relative;
  if (pair.reference == second_id && pair.station == first_id) return relative.seen_from_the_other();
  return std::nullopt;
}

std::optional<motion::StationRelative> StationSurvey::relative(const std::optional<std::uint32_t>& first_id,
                                                               const std::optional<std::uint32_t>& second_id) const {
  if (pair == nullptr || !first_id || !second_id) return std::nullopt;
  return relative_pose(*pair, *first_id, *second_id);
}

}  // namespace pharos::tracking
