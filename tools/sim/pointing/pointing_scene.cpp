// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tools/sim/pointing/pointing_image.hpp"
#include "tools/sim/pointing/sky_frames.hpp"
#include "tools/sim/povray/scene_text.hpp"

namespace pharos::sim {
namespace {

// Cells of half a metre with bright gaps between them, which stand back from the panel's border.
constexpr double kCell_m = 0.5;
constexpr double kGap_m = 0.012;
constexpr double kBorder_m = 0.06;
constexpr double kAboveCells_m = 0.0005;

std::string box(const Vector3& low, const Vector3& high, const char* texture) {
  return "box { " + povray_vector({low.x(), high.y(), low.z()}) + ", " + povray_vector({high.x(), low.y(), high.z()}) +
         " texture { " + texture + " } }\n";
}

// A panel from x = `from` on, its bright side at z = 0.
std::string panel(const PointingSatellite& satellite, double from) {
  const double length = satellite.panel_length_m, half = 0.5 * satellite.panel_width_m;
  std::string text = box({from, -half, -satellite.panel_thickness_m}, {from + length, half, 0.0}, "Cells");
  for (double x = kCell_m; x < length - kBorder_m; x += kCell_m) {
    text += box({from + x - 0.5 * kGap_m, -half + kBorder_m, 0.0},
                {from + x + 0.5 * kGap_m, half - kBorder_m, kAboveCells_m}, "Gaps");
  }
  for (double y = kCell_m - half; y < half - kBorder_m; y += kCell_m) {
    text += box({from + kBorder_m, y - 0.5 * kGap_m, 0.0}, {from + length - kBorder_m, y + 0.5 * kGap_m, kAboveCells_m},
                "Gaps");
  }
  return text;
}

std::string truss(const PointingSatellite& satellite, double from) {
  std::string text;
  for (const double y : {-0.3, 0.3}) {
    text += "cylinder { " + povray_vector({from, y, -0.05}) + ", " +
            povray_vector({from + satellite.truss_m, 0.5 * y, -0.05}) + ", 0.03 texture { Metal } }\n";
  }
  return text;
}

std::string body(const PointingSatellite& satellite) {
  const Vector3 half = 0.5 * satellite.body_m;
  return box({-half.x(), -half.y(), -half.z()}, {half.x(), half.y(), half.z()}, "Foil") + "cylinder { " +
         povray_vector({0.0, 0.0, half.z()}) + ", " + povray_vector({0.0, 0.0, half.z() + 0.6}) +
         ", 0.35 texture { Metal } }\n";
}

// The body's frame to the scene's, for points that went through povray_vector: columns are the images of its axes. The
// scene's frame is the camera's with the satellite's middle as origin: POV-Ray keeps bounding boxes in single
// precision.
std::string placed(const Matrix3& R_camera_body) {
  const Vector3 flip(1.0, -1.0, 1.0);
  const Matrix3 R = flip.asDiagonal() * R_camera_body * flip.asDiagonal();
  return fmt::format("matrix <{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},0,0,0>\n",
                     R(0, 0), R(1, 0), R(2, 0), R(0, 1), R(1, 1), R(2, 1), R(0, 2), R(1, 2), R(2, 2));
}

constexpr const char* kTextures =
    "#declare Cells = texture { pigment { rgb 0.42 } finish { ambient 0 diffuse 0.9 } }\n"
    "#declare Gaps = texture { pigment { rgb 0.6 } finish { ambient 0 diffuse 0.9 } }\n"
    "#declare Metal = texture { pigment { rgb 0.7 } finish { ambient 0 diffuse 0.8 } }\n"
    "#declare Foil = texture { pigment { rgb 0.65 } normal { bumps 0.25 scale 0.12 } finish { ambient 0 diffuse 0.8 } "
    "}\n";

}  // namespace

std::string pointing_scene(const PointingScenario& scenario, const PointingView& view, const Vector2& middle_px) {
  const Lens& camera = scenario.camera;
  const Matrix3 R_camera_station = station_from_camera(view.azimuth_rad, view.elevation_rad).transpose();
  const Vector3 place = view.range_m * Vector3((middle_px.x() - camera.cx_px) / camera.fx_px,
                                               (middle_px.y() - camera.cy_px) / camera.fy_px, 1.0);
  const Vector3 to_sun = R_camera_station * view.to_sun_station;
  const PointingSatellite& satellite = scenario.satellite;
  const double inner = 0.5 * satellite.body_m.x() + satellite.truss_m;
  std::string parts = panel(satellite, inner) + truss(satellite, 0.5 * satellite.body_m.x()) + body(satellite);
  if (satellite.panels == 2) {
    parts += panel(satellite, -inner - satellite.panel_length_m) + truss(satellite, -inner);
  }
  return povray_preamble() + povray_camera(camera, Matrix3::Identity(), -place) + kTextures + "light_source { " +
         povray_vector(1e5 * to_sun) + " rgb 1 parallel point_at <0,0,0>" + " }\nunion {\n" + parts +
         placed(R_camera_station * view.R_station_body) + "}\n";
}

}  // namespace pharos::sim
