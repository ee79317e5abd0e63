// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/optics/lens.hpp"

namespace pharos::sim {

/// The telescope's focal length: 600 px for 10 m at 100 m.
inline constexpr double kLineFocal_px = 6000.0;

/// A body with a wing of one or two panels along its x axis, on trusses; z is the panels' bright side.
struct PointingSatellite {
  int panels = 2;
  double panel_length_m = 10.0;
  double panel_width_m = 2.0;
  double panel_thickness_m = 0.02;
  double truss_m = 0.75;  ///< from the body to a panel
  Vector3 body_m{2.0, 2.0, 2.5};
};

/// What is between the satellite and the counts.
struct PointingImaging {
  double seeing_px = 1.2;    ///< sigma of the blur by air and optics
  double tracking_px = 3.0;  ///< sigma of where the satellite stands in the image, each way
  int stars = 60;
  double star_light = 0.3;  ///< of the brightest, in units of a white pixel once blurred
  double sky_light = 0.004;
  double antialias_threshold = 0.01;
  int rays_per_side = 9;  ///< fewer show as a grid along straight edges (README)
  ImageSensor sensor;     ///< the exposure is such that the satellite peaks at `peak` of the full well
  double peak = 0.8;
};

struct PointingStation {
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
};

/// One image's geometry.
struct PointingView {
  double time_s = 0.0;
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double range_m = 100.0;
  Matrix3 R_station_body = Matrix3::Identity();
  Vector3 to_sun_station = Vector3::UnitZ();
};

struct PointingScenario {
  Lens camera = centred_lens(1024, 1024, kLineFocal_px);  ///< without distortion
  PointingSatellite satellite;
  PointingImaging imaging;
  PointingStation station;
  std::vector<PointingView> views;
  bool write_range = true;  ///< the track file tells ranges
};

/// Reads and checks a scenario file. The seed decides random attitudes and suns. Throws host::InputError naming file,
/// line and key.
PointingScenario read_pointing_scenario(const std::filesystem::path& path, std::uint64_t seed);

}  // namespace pharos::sim
