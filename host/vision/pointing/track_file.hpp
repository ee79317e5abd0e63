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

/// One image of a pass and where the telescope pointed.
struct TrackRow {
  std::string image;  ///< as written in the file
  pointing::Observation observation;
  /// Empty, or the word after refused_: track_gap (time, azimuth or elevation is missing), azimuth_out_of_range,
  /// elevation_out_of_range.
  std::string refusal;
};

struct TrackFile {
  std::vector<TrackRow> rows;
  std::optional<pointing::Geodetic> station;  ///< where the file tells it
};

/// Azimuth may be told either way round; below the horizon no telescope looks.
inline constexpr double kMinAzimuth_deg = -180.0, kMaxAzimuth_deg = 360.0;
inline constexpr double kMinElevation_deg = 0.0, kMaxElevation_deg = 90.0;

/// Reads `image,time_s,azimuth_deg,elevation_deg` and, where they are there, `range_m` (m, above 0) and `latitude_deg`,
/// `longitude_deg`, `height_m` (the station's, the same in every row). Throws host::InputError naming file, line and
/// column for what is no table, times that do not grow, two stations. `last_line`: of a file that still grows.
TrackFile read_track(host::ByteSource source, host::LastLine last_line = host::LastLine::kAccept);
/// The same of a file; `-` is standard input.
TrackFile read_track_file(const std::string& path);
/// An image's path: beside the track file where it is relative.
std::filesystem::path image_path(const std::string& track_file, const std::string& image);

}  // namespace pharos::pointing
