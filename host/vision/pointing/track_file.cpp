// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/track_file.hpp"

#include <utility>

#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"

namespace pharos::pointing {
namespace {

constexpr std::size_t kImage = 0, kTime = 1, kAzimuth = 2, kElevation = 3;

// An optional column and its values.
class Optional {
 public:
  Optional(host::TableReader& table, const std::string& column, double low, double high)
      : index_(table.find_optional(column)), low_(low), high_(high) {}

  std::optional<double> value(const host::TableReader& table) const {
    if (!index_) return std::nullopt;
    const auto number = table.optional_number(*index_);
    if (number && (*number < low_ || *number > high_)) {
      table.fail(*index_,
                 std::to_string(*number) + " is not from " + std::to_string(low_) + " to " + std::to_string(high_));
    }
    return number;
  }

 private:
  std::optional<std::size_t> index_;
  double low_, high_;
};

std::string refusal_of(const std::optional<double>& time, const std::optional<double>& azimuth,
                       const std::optional<double>& elevation) {
  if (!time || !azimuth || !elevation) return "track_gap";
  if (*azimuth < kMinAzimuth_deg || *azimuth > kMaxAzimuth_deg) return "azimuth_out_of_range";
  if (*elevation < kMinElevation_deg || *elevation > kMaxElevation_deg) return "elevation_out_of_range";
  return "";
}

bool is_same(const pointing::Geodetic& a, const pointing::Geodetic& b) {
  return a.latitude_rad == b.latitude_rad && a.longitude_rad == b.longitude_rad && a.height_m == b.height_m;
}

}  // namespace

TrackFile read_track(host::ByteSource source, host::LastLine last_line) {
  host::TableReader table(std::move(source), {"image", "time_s", "azimuth_deg", "elevation_deg"}, last_line);
  const Optional range(table, "range_m", 1.0, 1e12), latitude(table, "latitude_deg", -90.0, 90.0),
      longitude(table, "longitude_deg", -180.0, 360.0), height(table, "height_m", -500.0, 9000.0);
  TrackFile track;
  std::optional<double> last_time;
  while (table.next()) {
    TrackRow row;
    row.image = table.text(kImage);
    if (row.image.empty()) table.fail(kImage, "is empty; name the image's file");
    const auto time = table.optional_number(kTime), azimuth = table.optional_number(kAzimuth),
               elevation = table.optional_number(kElevation);
    if (time && last_time && *time <= *last_time) table.fail(kTime, "must be later than in the row before");
    if (time) last_time = time;
    row.refusal = refusal_of(time, azimuth, elevation);
    row.observation = {time.value_or(0.0),
                       {azimuth.value_or(0.0) * kRadPerDeg, elevation.value_or(0.0) * kRadPerDeg},
                       range.value(table).value_or(0.0)};
    const auto b = latitude.value(table), l = longitude.value(table), h = height.value(table);
    if (b && l) {
      const pointing::Geodetic station{*b * kRadPerDeg, *l * kRadPerDeg, h.value_or(0.0)};
      if (track.station && !is_same(*track.station, station)) table.fail_row("another station than in the rows before");
      track.station = station;
    }
    track.rows.push_back(row);
  }
  return track;
}

TrackFile read_track_file(const std::string& path) { return read_track(host::ByteSource(path)); }

std::filesystem::path image_path(const std::string& track_file, const std::string& image) {
  if (track_file == "-") return image;
  return std::filesystem::path(track_file).parent_path() / image;
}

}  // namespace pharos::pointing
