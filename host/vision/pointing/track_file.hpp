// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/table/line_reader.hpp"
#include "pharos/pointing/orbit.hpp"

namespace pharos::pointing {

/// One image of a pass and the telescope's direction.
struct TrackRow {
  std::string image;  ///< as written in the file
  pointing::Observation observation;
  /// Empty, or the word after refused_: track_gap (time, azimuth or elevation is missing), azimuth_out_of_range,
  /// elevation_out_of_range.
  std::string refusal;
};

struct TrackFile {
  std::vector<TrackRow> rows;
  std::optional<pointing::Geodetic> station;  ///< where the file contains it
};

/// Azimuth may be given in both conventions; elevations below the horizon are refused.
inline constexpr double kMinAzimuth_deg = -180.0, kMaxAzimuth_deg = 360.0;
inline constexpr double kMinElevation_deg = 0.0, kMaxElevation_deg = 90.0;

/// Reads `image,time_s,azimuth_deg,elevation_deg` and, optionally, `range_m` (m, above 0) and `latitude_deg`,
/// `longitude_deg`, `height_m` (the station's, the same in every row). Throws host::InputError naming file, line and
/// column for an invalid table, times that do not increase, two stations. `last_line`: for a file that is still being
/// written.
TrackFile read_track(host::ByteSource source, host::LastLine last_line = host::LastLine::kAccept);
/// The same of a file; `-` is standard input.
TrackFile read_track_file(const std::string& path);
/// An image's path: relative ones start at the track file's folder.
std::filesystem::path image_path(const std::string& track_file, const std::string& image);

}  // namespace pharos::pointing
