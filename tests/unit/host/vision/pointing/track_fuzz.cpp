// SPDX-License-Identifier: Apache-2.0
// Any bytes as a track file: rows that can be worked with, or a complaint.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "host/support/input_error.hpp"
#include "host/vision/pointing/track_file.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

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
  const int fd = memfd_create("fuzz", 0);
  if (::write(fd, data, size) != static_cast<ssize_t>(size)) std::abort();
  const std::string path = "/proc/self/fd/" + std::to_string(fd);
  read_all(path, pharos::host::LastLine::kAccept);
  read_all(path, pharos::host::LastLine::kDropUnfinished);
  ::close(fd);
  return 0;
}
