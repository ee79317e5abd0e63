// SPDX-License-Identifier: Apache-2.0
#include <sstream>

#include "host/config/load_config.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

const char* yes_no(bool value) { return value ? "yes" : "no"; }

void describe_log(std::ostream& out, const LogConfig& log) {
  out << "log: level " << log.level << ", to ";
  switch (log.sink) {
    case LogSink::kStandardError:
      out << "standard error\n";
      break;
    case LogSink::kSyslog:
      out << "syslog\n";
      break;
    case LogSink::kFile:
      out << log.file.string() << '\n';
      break;
  }
}

void describe_recording(std::ostream& out, const std::optional<RecordingConfig>& recording) {
  if (!recording) {
    out << "recording: off\n";
    return;
  }
  out << "recording: " << recording->directory.string() << ", a new file every "
      << static_cast<double>(recording->rotate_bytes) / (1 << 20) << " MiB or " << recording->rotate_s / 60.0
      << " minutes\n";
}

void describe_target(std::ostream& out, const TargetConfig& target) {
  out << "target " << target.name << ":\n  port: " << target.port;
  if (!target.is_replay()) out << " at " << target.baud << " baud";
  out << "\n  sensors: " << target.shape.sensors << " from " << target.target_file.string();
  if (target.shape.coplanar) out << " (all in one plane: single cycles may fit two poses)";
  if (!target.calibration_file.empty()) {
    out << "\n  calibrated: " << target.calibrated_stations.size() << " stations and the sensors, from "
        << target.calibration_file.string() << ", size known to " << 100.0 * target.scale_sigma << " %";
  }
  out << "\n  solve: sigma " << target.track.solve.sigma_rad * kArcsecPerRad << " arcsec, rho "
      << target.track.solve.rho << ", station model form " << static_cast<int>(target.track.form)
      << ", smoothed flashes: " << yes_no(target.track.smooth_flashes) << ", prior younger than "
      << target.track.prior_max_age_s << " s\n  remembers calibrations: " << yes_no(target.remember_calibrations)
      << '\n';
}

}  // namespace

std::string describe(const DaemonConfig& config) {
  std::ostringstream out;
  out << "source: " << config.source << "\nlcm: " << config.lcm.url << ", channels " << config.lcm.channel_prefix
      << "LIGHTHOUSE_POSE" << (config.publish.bearings ? ", " + config.lcm.channel_prefix + "LIGHTHOUSE_BEARINGS" : "")
      << ", " << config.lcm.channel_prefix << "STATUS\npublish: poses younger than " << config.publish.max_age_s
      << " s, status every " << config.publish.status_period_s << " s\nstate directory: "
      << (config.state_directory.empty() ? "none: calibrations are forgotten at a restart"
                                         : config.state_directory.string())
      << '\n';
  describe_recording(out, config.recording);
  describe_log(out, config.log);
  for (const TargetConfig& target : config.targets) describe_target(out, target);
  return out.str();
}

}  // namespace pharos::host
