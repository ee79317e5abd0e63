// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/pointing_kind.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/cameras/camera_file.hpp"
#include "host/images/grey_image.hpp"
#include "host/vision/pointing/measure_panel.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/optics/tone_curve.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/pointing/random_satellite.hpp"
#include "tools/sim/pointing/sky_frames.hpp"

namespace pharos::tools {
namespace {

constexpr double kTolerance_deg = 1.0;
// Where every telescope of the campaign points.
constexpr double kAzimuth_rad = 1.0, kElevation_rad = 0.7;
// The rule of availability.
constexpr double kMinFromSight_rad = 20.0 * kRadPerDeg;
constexpr double kMaxPanelTilt_rad = 60.0 * kRadPerDeg, kMaxSunIncidence_rad = 65.0 * kRadPerDeg;
constexpr double kMinPanel_px = 120.0;

bool is_answerable(const sim::RandomSatellite& satellite) {
  return satellite.in_image && satellite.from_sight_rad > kMinFromSight_rad &&
         satellite.panel_tilt_rad < kMaxPanelTilt_rad && satellite.sun_incidence_rad < kMaxSunIncidence_rad &&
         satellite.panel_px > kMinPanel_px;
}

IntegrityTrial trial_of(std::uint64_t seed, double tone_power) {
  const sim::RandomSatellite satellite = sim::random_satellite(seed);
  host::GreyImage image = sim::image_of(satellite, seed);
  sim::apply_tone_curve(image, tone_power);
  IntegrityTrial trial;
  trial.answerable = is_answerable(satellite);
  const auto panel = pointing::measure_panel(image.view(), sim::optics_as<PinholeCamera>(satellite.lens));
  if (!panel) {
    trial.status = std::string("refused_") + pointing::name_of(panel.error());
    return trial;
  }
  const pointing::PointingResult answer =
      pointing::answer_of(*panel, {kAzimuth_rad, kElevation_rad}, pointing::tone_of_bits(image.bits));
  trial.status = answer.second_axis ? "ambiguous" : "ok";
  const Vector3 truth = sim::station_from_camera(kAzimuth_rad, kElevation_rad) * satellite.axis_camera;
  const double error_deg = std::asin(std::min(1.0, answer.axis.axis.cross(truth).norm())) * kDegPerRad;
  trial.deviations.push_back({"axis, deg", error_deg, answer.axis.sigma_rad() * kDegPerRad, kTolerance_deg});
  // Where perspective hardly tells the axis, its plane is the answer.
  const double off_plane_deg = std::asin(std::min(1.0, std::abs(answer.axis.plane.normal.dot(truth)))) * kDegPerRad;
  trial.deviations.push_back({"plane, deg", off_plane_deg, answer.axis.sigma_plane_rad * kDegPerRad, kTolerance_deg});
  return trial;
}

void write_image(std::uint64_t seed, const std::filesystem::path& folder, double tone_power) {
  const sim::RandomSatellite satellite = sim::random_satellite(seed);
  sim::make_output_folder(folder);
  host::CameraFile file;
  file.camera.intrinsics = sim::optics_as<PinholeCamera>(satellite.lens);
  sim::write_output(folder / "camera.toml", host::camera_text(file));
  host::GreyImage image = sim::image_of(satellite, seed);
  sim::apply_tone_curve(image, tone_power);
  host::write_grey_png((folder / "image.png").string(), std::as_const(image).view(), 8);
}

}  // namespace

IntegrityKind pointing_kind() {
  return {
      "line",
      "every panel is whole in the image, one of them longer than 120 px, the axis more than 20 deg off the line of "
      "sight, the panels' normal within 60 deg of it, the sun within 65 deg of that normal",
      [](std::uint64_t seed) { return trial_of(seed, 1.0); }, write_image,
      [](std::uint64_t seed) { return trial_of(seed, sim::tone_power(seed)); }};
}

}  // namespace pharos::tools
