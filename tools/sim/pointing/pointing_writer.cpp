// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pointing/pointing_writer.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/cameras/camera_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/pointing/pointing_image.hpp"
#include "tools/sim/pointing/sky_frames.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;

// The upper end of the axis, as formula (1) and the rule for its sign have it.
Vector3 upper(const Vector3& axis) { return axis.z() < 0.0 || (axis.z() == 0.0 && axis.y() < 0.0) ? -axis : axis; }

void write_direction(host::RowWriter& rows, const Vector3& d) {
  rows.number(std::asin(std::clamp(d.z(), -1.0, 1.0)) * kDegPerRad).number(std::atan2(d.x(), d.y()) * kDegPerRad);
  rows.number(d.x()).number(d.y()).number(d.z());
}

void write_track(host::RowWriter& rows, const std::string& name, const PointingView& view,
                 const PointingScenario& scenario) {
  rows.text(name).number(view.time_s);
  rows.number(view.azimuth_rad * kDegPerRad).number(view.elevation_rad * kDegPerRad);
  rows.number(scenario.station.latitude_rad * kDegPerRad).number(scenario.station.longitude_rad * kDegPerRad);
  rows.number(scenario.station.height_m);
  if (scenario.write_range) rows.number(view.range_m);
  rows.end_row();
}

void write_truth(host::RowWriter& rows, const std::string& name, const PointingView& view,
                 const PointingStation& station) {
  const Vector3 axis = upper(view.R_station_body.col(0));
  rows.text(name).number(view.time_s);
  write_direction(rows, axis);
  write_direction(rows, earth_from_station(station) * axis);
  const Vector3 side = upper(view.R_station_body.col(1));
  rows.number(side.x()).number(side.y()).number(side.z()).number(view.range_m).end_row();
}

}  // namespace

void write_pointing_images(const PointingScenario& scenario, std::uint64_t seed, const fs::path& folder,
                           const std::function<void()>& done) {
  make_output_folder(folder);
  host::CameraFile file;
  file.camera.intrinsics = optics_as<PinholeCamera>(scenario.camera);
  write_output(folder / "camera.toml", host::camera_text(file));
  std::vector<std::string> columns{"image",        "time_s",        "azimuth_deg", "elevation_deg",
                                   "latitude_deg", "longitude_deg", "height_m"};
  if (scenario.write_range) columns.emplace_back("range_m");
  TableFile track(folder / "track.csv", columns);
  TableFile truth(folder / "truth.csv",
                  {"image", "time_s", "pitch_deg", "yaw_deg", "sx", "sy", "sz", "earth_pitch_deg", "earth_yaw_deg",
                   "ex", "ey", "ez", "short_x", "short_y", "short_z", "range_m"});
  for (std::size_t k = 0; k < scenario.views.size(); ++k) {
    const std::string name = file_number(k, scenario.views.size()) + ".png";
    host::write_grey_png((folder / name).string(), pointing_image(scenario, k, seed).view(),
                         scenario.imaging.sensor.bits);
    write_track(track.rows(), name, scenario.views[k], scenario);
    write_truth(truth.rows(), name, scenario.views[k], scenario.station);
    track.rows().flush();
    truth.rows().flush();
    done();
  }
}

}  // namespace pharos::sim
