// SPDX-License-Identifier: Apache-2.0
#include "tools/pointing/pointing_table.hpp"

#include <cmath>

#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

const std::vector<std::string> kContract = {
    "image", "pitch_deg",       "yaw_deg",       "sx",        "sy",       "sz",       "ex",       "ey",
    "ez",    "earth_pitch_deg", "earth_yaw_deg", "sigma_deg", "plane_nx", "plane_ny", "plane_nz", "sigma_plane_deg",
    "status"};
const std::vector<std::string> kQuality = {"flags",  "sigma_along_deg", "square_deg",  "sigma_square_deg",
                                           "panels", "edges",           "edge_rms_px", "blur_px"};
const std::vector<std::string> kPass = {
    "law",    "chi2",   "degrees_of_freedom", "images", "set_aside", "time_s", "spin_x",
    "spin_y", "spin_z", "spin_rate_deg_s",    "alt_sx", "alt_sy",    "alt_sz"};

void write_vector(host::RowWriter& rows, const Vector3& v) { rows.number(v.x()).number(v.y()).number(v.z()); }

void write_axis(host::RowWriter& rows, const Vector3& axis, const std::optional<pointing::Geodetic>& station) {
  const pointing::PitchYaw angles = pointing::pitch_yaw(axis);
  rows.number(angles.pitch_rad * kDegPerRad).number(angles.yaw_rad * kDegPerRad);
  write_vector(rows, axis);
  if (!station) {
    rows.none(5);
    return;
  }
  const Vector3 earth = pointing::station_to_earth(*station) * axis;
  const pointing::PitchYaw of_earth = pointing::pitch_yaw(earth);
  write_vector(rows, earth);
  rows.number(of_earth.pitch_rad * kDegPerRad).number(of_earth.yaw_rad * kDegPerRad);
}

// A spin axis in S at the pass' middle, turning the positive way.
void write_spin(host::RowWriter& rows, const pointing::SpinEstimate& estimate, const pointing::Geodetic& station) {
  const bool back = estimate.spin.rate_rad_s < 0.0;
  const Vector3 spin = pointing::station_to_earth(station).transpose() * estimate.spin.spin;
  write_vector(rows, back ? Vector3(-spin) : spin);
  rows.number(std::abs(estimate.spin.rate_rad_s) * kDegPerRad);
}

}  // namespace

std::vector<std::string> pointing_columns() {
  std::vector<std::string> columns = kContract;
  columns.insert(columns.end(), kQuality.begin(), kQuality.end());
  columns.insert(columns.end(), kPass.begin(), kPass.end());
  return columns;
}

void write_image(host::RowWriter& rows, const std::string& image, const pointing::PanelMeasurement& panel,
                 const pointing::PointingResult& answer, const std::optional<pointing::Geodetic>& station) {
  rows.text(image);
  write_axis(rows, answer.axis.axis, station);
  rows.number(answer.axis.sigma_rad() * kDegPerRad);
  write_vector(rows, pointing::signed_axis(answer.axis.plane.normal));
  rows.number(answer.axis.sigma_plane_rad * kDegPerRad).text(answer.second_axis ? "ambiguous" : "ok");
  rows.text(host::joined_flags(answer.flags, pointing::kPointingFlagWords))
      .number(answer.axis.sigma_along_rad * kDegPerRad);
  if (answer.square_rad) {
    rows.number(*answer.square_rad * kDegPerRad).number(answer.sigma_square_rad * kDegPerRad);
  } else {
    rows.none(2);
  }
  rows.integer(panel.panels).integer(static_cast<std::int64_t>(panel.long_planes.size()));
  rows.number(panel.rms_px).number(panel.blur_px);
  constexpr std::size_t kAxis = 3;  // the last columns: alt_sx, alt_sy, alt_sz
  rows.none(kPass.size() - kAxis);
  if (answer.second_axis) {
    write_vector(rows, *answer.second_axis);
  } else {
    rows.none(kAxis);
  }
  rows.end_row();
}

void write_paper_axis(host::RowWriter& rows, const std::string& image, const Vector3& axis_station,
                      const std::optional<double>& square_rad, const std::optional<pointing::Geodetic>& station) {
  rows.text(image);
  write_axis(rows, pointing::signed_axis(axis_station), station);
  rows.none(5).text("ok").none(2);  // sigma and plane; flags, sigma along the axis
  rows.number(square_rad ? std::optional(*square_rad * kDegPerRad) : std::nullopt).none(kQuality.size() - 3);
  rows.none(kPass.size()).end_row();
}

void write_pointing_refusal(host::RowWriter& rows, const std::string& image, const std::string& reason) {
  rows.text(image).none(kContract.size() - 2).text("refused_" + reason).none(kQuality.size() + kPass.size()).end_row();
}

void write_pass(host::RowWriter& rows, const pointing::PassSolution& answer, pointing::AttitudeLaw law,
                const pointing::Geodetic& station) {
  const pointing::PassEstimate& pass = answer.estimate;
  rows.text("pass");
  if (answer.failure) {
    rows.none(kContract.size() - 2).text(std::string("refused_") + pointing::name_of(*answer.failure));
  } else {
    write_axis(rows, pass.axis_station, station);
    rows.number(pass.sigma_rad() * kDegPerRad).none(4).text(pass.second_axis_station ? "ambiguous" : "ok");
  }
  rows.none(kQuality.size()).text(pointing::name_of(law));
  if (pass.degrees_of_freedom > 0) {
    rows.number(pass.chi2).integer(pass.degrees_of_freedom);
  } else {
    rows.none(2);
  }
  rows.integer(pass.images).integer(pass.rejected).number(pass.time_s);
  if (pass.spin) {
    write_spin(rows, *pass.spin, station);
  } else {
    rows.none(4);
  }
  if (pass.second_axis_station) {
    write_vector(rows, *pass.second_axis_station);
  } else {
    rows.none(3);
  }
  rows.end_row();
}

}  // namespace pharos::tools
