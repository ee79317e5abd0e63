// SPDX-License-Identifier: Apache-2.0
// The functions that PublishGate needs of every report: its channel, and whether its numbers are finite.
#include <algorithm>
#include <cmath>

#include "host/publish/cycle_report.hpp"
#include "host/publish/finite.hpp"
#include "host/publish/pointing_report.hpp"
#include "host/publish/spin_report.hpp"
#include "host/publish/stereo_report.hpp"
#include "host/publish/tof_report.hpp"

namespace pharos::host {

const char* channel_of(const CycleReport&) { return "LIGHTHOUSE_POSE"; }
const char* channel_of(const WorldPoseReport&) { return "LIGHTHOUSE_POSE"; }
const char* channel_of(const BoardPoseReport&) { return "LIGHTHOUSE_BOARD_POSE"; }
const char* channel_of(const BearingsReport&) { return "LIGHTHOUSE_BEARINGS"; }
const char* channel_of(const TofReport&) { return "TOF_POSE"; }
const char* channel_of(const StereoReport& report) { return report.of_slam() ? "SLAM_POSE" : "RING2_POSE"; }
const char* channel_of(const SpinReport&) { return "SLAM_SPIN"; }
const char* channel_of(const PointingReport&) { return "LINE_POINTING"; }

bool is_finite(const CycleReport& report) { return is_finite(report.pose); }

bool is_finite(const WorldPoseReport& report) { return is_finite(report.pose); }

bool is_finite(const BearingsReport& report) {
  return std::all_of(report.bearings.begin(), report.bearings.end(), [](const ReportedBearing& bearing) {
    return std::isfinite(bearing.raw_theta_rad) && std::isfinite(bearing.ideal_theta_rad) &&
           std::isfinite(bearing.residual_rad);
  });
}

bool is_finite(const TofReport& report) { return is_finite(report.pose); }

bool is_finite(const StereoReport& report) {
  return std::visit([](const auto& pose) { return is_finite(pose); }, report.pose);
}

bool is_finite(const SpinReport& report) {
  const SpinEstimate& spin = report.spin;
  return spin.rate_rad_s.allFinite() && spin.covariance.allFinite() && spin.axis.allFinite() &&
         std::isfinite(spin.sigma_rate_rad_s) && std::isfinite(spin.sigma_axis_rad) &&
         std::isfinite(spin.residual_rms_rad) && std::isfinite(spin.span_s);
}

bool is_finite(const PointingReport& report) {
  return report.axis_station.allFinite() && report.axis_earth.allFinite() && report.covariance_station.allFinite() &&
         report.plane_normal_station.allFinite() && std::isfinite(report.sigma_plane_rad);
}

}  // namespace pharos::host
