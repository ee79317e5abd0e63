// SPDX-License-Identifier: Apache-2.0
// Any bytes as a track file: valid rows, or an InputError.
#include <cmath>
#include <cstdint>
#include <string>

#include "host/support/input_error.hpp"
#include "host/vision/pointing/track_file.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::MemoryFile;
using pharos::test::require;

void read_all(const std::string& path, pharos::host::LastLine last_line) {
  try {
    const auto track = pharos::pointing::read_track(pharos::host::ByteSource(path), last_line);
    double last = -INFINITY;
    for (const auto& row : track.rows) {
      require(!row.image.empty() && std::isfinite(row.observation.time_s) && std::isfinite(row.observation.range_m));
      if (!row.refusal.empty()) continue;
      require(row.observation.time_s > last && row.observation.range_m >= 0.0);
      require(row.observation.sight.elevation_rad >= 0.0 && row.observation.sight.elevation_rad < 1.6);
      last = row.observation.time_s;
    }
    if (track.station) require(std::abs(track.station->latitude_rad) < 1.6);
  } catch (const pharos::host::InputError& error) {
    require(error.what()[0] != '\0');
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  const std::string path = file.path();
  read_all(path, pharos::host::LastLine::kAccept);
  read_all(path, pharos::host::LastLine::kDropUnfinished);
  return 0;
}
