// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/pointing_rows.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/support/printable.hpp"
#include "pharos/base/units.hpp"
#include "pharos/pointing_t.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {
namespace {

nlohmann::ordered_json json_of(const double (&vector)[3]) { return {vector[0], vector[1], vector[2]}; }

}  // namespace

std::string pointing_line(const pointing_t& pointing) {
  std::string out = fmt::format("{} {} {} {}", clock_text(pointing.utime), pointing.target,
                                pointing.from_pass != 0 ? "pass" : "image", pointing.status);
  if (pointing.valid != 0) {
    out += fmt::format("  pitch {:.3f} yaw {:.3f} deg  sigma {:.3f} deg  plane sigma {:.4f} deg  {} images",
                       pointing.pitch_rad * kDegPerRad, pointing.yaw_rad * kDegPerRad,
                       pointing.sigma_axis_rad * kDegPerRad, pointing.sigma_plane_rad * kDegPerRad, pointing.images);
  }
  return host::printable(pointing.flags.empty() ? out : out + "  " + pointing.flags);
}

std::string pointing_json(const pointing_t& pointing) {
  nlohmann::ordered_json out = {{"utime", pointing.utime},       {"source", pointing.source},
                                {"target", pointing.target},     {"camera", pointing.station_or_camera},
                                {"sequence", pointing.sequence}, {"from_pass", pointing.from_pass != 0},
                                {"images", pointing.images},     {"status", pointing.status},
                                {"flags", pointing.flags}};
  const bool valid = pointing.valid != 0;
  const auto add = [&](const char* name, const nlohmann::ordered_json& value) {
    out[name] = valid ? value : nlohmann::ordered_json();
  };
  add("pitch_deg", pointing.pitch_rad * kDegPerRad);
  add("yaw_deg", pointing.yaw_rad * kDegPerRad);
  add("axis_station", json_of(pointing.axis_station));
  add("axis_earth", json_of(pointing.axis_earth));
  add("sigma_deg", pointing.sigma_axis_rad * kDegPerRad);
  add("plane_normal_station", json_of(pointing.plane_normal_station));
  add("sigma_plane_deg", pointing.sigma_plane_rad * kDegPerRad);
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace pharos::tools
