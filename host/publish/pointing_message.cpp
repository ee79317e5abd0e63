// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "host/publish/messages.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

void fill(const Vector3& v, double (&out)[3]) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

}  // namespace

pointing_t message_of(const PointingReport& report) {
  pointing_t message{};
  message.utime = report.utc_ns / kNsPerUs;
  message.sequence = report.sequence;
  message.source = report.source;
  message.station_or_camera = report.sensor;
  message.target = report.target;
  message.flags = report.flags;
  message.from_pass = report.from_pass ? 1 : 0;
  message.images = report.images;
  message.status = status_word(report);
  message.valid = report.answered() ? 1 : 0;
  if (!report.answered()) return message;
  const Vector3 &s = report.axis_station, &e = report.axis_earth;
  fill(s, message.axis_station);
  fill(e, message.axis_earth);
  message.pitch_rad = std::asin(std::clamp(s.z(), -1.0, 1.0));
  message.yaw_rad = std::atan2(s.x(), s.y());
  message.earth_pitch_rad = std::asin(std::clamp(e.z(), -1.0, 1.0));
  message.earth_yaw_rad = std::atan2(e.x(), e.y());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.axis_covariance[3 * row + column] = report.covariance_station(row, column);
    }
  }
  message.sigma_axis_rad = std::sqrt(report.covariance_station.trace());
  fill(report.plane_normal_station, message.plane_normal_station);
  message.sigma_plane_rad = report.sigma_plane_rad;
  return message;
}

}  // namespace pharos::host
