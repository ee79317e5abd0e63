// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "host/publish/messages.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {

spin_t message_of(const SpinReport& report) {
  spin_t message{};
  message.utime = report.utc_ns / kNsPerUs;
  message.sequence = report.sequence;
  message.source = report.source;
  message.station_or_camera = report.sensor;
  message.target = report.target;
  message.reference_frame = report.frames.parent;
  message.status = status_word(report);
  message.valid = report.answered() ? 1 : 0;
  if (!report.answered()) return message;
  const SpinEstimate& spin = report.spin;
  std::copy_n(spin.rate_rad_s.data(), 3, message.rate_rad_s);
  std::copy_n(spin.axis.data(), 3, message.axis);
  std::copy_n(spin.covariance.data(), 9, message.covariance);  // symmetric: rows are columns
  message.sigma_rate_rad_s = spin.sigma_rate_rad_s;
  message.sigma_axis_rad = spin.sigma_axis_rad;
  message.residual_rms_rad = spin.residual_rms_rad;
  message.attitudes = spin.attitudes;
  message.span_s = spin.span_s;
  return message;
}

}  // namespace pharos::host
