// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/pointing/attitude_tables.hpp"

#include <array>
#include <cstdio>
#include <string>

#include "host/vision/pointing/measure_panel.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/pointing/pointing_image.hpp"
#include "tools/sim/pointing/pointing_views.hpp"
#include "tools/sim/pointing/sky_frames.hpp"

namespace pharos::tools {
namespace {

// As printed; the roll about the axis is not told and ours.
struct Published {
  double azimuth_deg, elevation_deg, pitch_deg, yaw_deg, roll_deg;
  const char *earth_pitch_deg, *earth_yaw_deg;
  const char* square_deg;
};
constexpr std::array<Published, 4> kPublished = {Published{288, 52, -33.7, 72.0, 15, "85.9", "-9.9", "91.541"},
                                                 Published{180, 71, -62.8, -0.01, 0, "38.5", "69.9", "88.843"},
                                                 Published{15, 55, 77.9, 28.9, -10, "-22.5", "-69.5", "88.295"},
                                                 Published{138, 33, 36.4, 41.9, 25, "17.4", "-56.3", "88.917"}};
constexpr double kLatitude_deg = 34.27, kLongitude_deg = 108.95;
constexpr double kRange_m = 100.0;
constexpr std::int32_t kSide_px = 1536;

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

sim::PointingScenario scenario_of(std::uint64_t seed) {
  sim::PointingScenario scenario;
  scenario.camera = sim::centred_lens(kSide_px, kSide_px, sim::kLineFocal_px);
  scenario.imaging.sensor.bits = 16;
  scenario.station = {kLatitude_deg * kRadPerDeg, kLongitude_deg * kRadPerDeg, 0.0};
  sim::RandomStream random(seed, "line views");
  for (const Published& row : kPublished) {
    sim::PointingView view;
    view.azimuth_rad = row.azimuth_deg * kRadPerDeg;
    view.elevation_rad = row.elevation_deg * kRadPerDeg;
    view.range_m = kRange_m;
    const Vector3 sight = sim::station_from_camera(view.azimuth_rad, view.elevation_rad).col(2);
    view.R_station_body = sim::station_from_body(
        sim::direction_of(row.pitch_deg * kRadPerDeg, row.yaw_deg * kRadPerDeg), sight, row.roll_deg * kRadPerDeg);
    view.to_sun_station = sim::sun_for(view, random);
    scenario.views.push_back(view);
  }
  return scenario;
}

void add_rows(std::vector<ComparisonRow>& rows, std::size_t k, const pointing::PointingResult& answer) {
  const Published& row = kPublished[k];
  const std::string name = "attitude " + std::to_string(k + 1) + ": ";
  const std::string sigma = "sigma " + number(answer.axis.sigma_rad() * kDegPerRad) + " deg";
  // The paper's end of the axis, not ours (sz >= 0).
  const Vector3 printed = pointing::axis_of({row.pitch_deg * kRadPerDeg, row.yaw_deg * kRadPerDeg});
  const Vector3 axis = answer.axis.axis.dot(printed) < 0.0 ? Vector3(-answer.axis.axis) : answer.axis.axis;
  const pointing::PitchYaw station = pointing::pitch_yaw(axis);
  const Vector3 in_earth =
      pointing::station_to_earth({kLatitude_deg * kRadPerDeg, kLongitude_deg * kRadPerDeg, 0.0}) * axis;
  const pointing::PitchYaw earth = pointing::pitch_yaw(in_earth);
  const std::string no_rotation = "no rotation gives the paper's Earth-fixed columns";
  rows.push_back({"table 1", name + "pitch", "deg", number(row.pitch_deg), station.pitch_rad * kDegPerRad, sigma});
  rows.push_back({"table 1", name + "yaw", "deg", number(row.yaw_deg), station.yaw_rad * kDegPerRad, sigma});
  rows.push_back(
      {"table 1", name + "Earth-fixed pitch", "deg", row.earth_pitch_deg, earth.pitch_rad * kDegPerRad, no_rotation});
  rows.push_back(
      {"table 1", name + "Earth-fixed yaw", "deg", row.earth_yaw_deg, earth.yaw_rad * kDegPerRad, no_rotation});
  if (answer.square_rad) {
    rows.push_back({"table 2", name + "long to short side", "deg", row.square_deg, *answer.square_rad * kDegPerRad,
                    "sigma " + number(answer.sigma_square_rad * kDegPerRad) + " deg"});
  }
}

}  // namespace

std::vector<ComparisonRow> reproduce_attitudes(std::uint64_t seed) {
  const sim::PointingScenario scenario = scenario_of(seed);
  const auto camera = sim::optics_as<PinholeCamera>(scenario.camera);
  std::vector<ComparisonRow> rows;
  int answered = 0;
  for (std::size_t k = 0; k < scenario.views.size(); ++k) {
    const sim::PointingView& view = scenario.views[k];
    const auto panel = pointing::measure_panel(sim::pointing_image(scenario, k, seed).view(), camera);
    if (!panel) continue;
    ++answered;
    add_rows(rows, k, pointing::answer_of(*panel, {view.azimuth_rad, view.elevation_rad}));
  }
  rows.push_back({"table 1", "attitudes answered", "", "4", static_cast<double>(answered),
                  "attitude 2 looks along the axis to 8 deg: one end of the panel is hidden, no right angle is seen"});
  return rows;
}

}  // namespace pharos::tools
