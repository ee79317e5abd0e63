// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdio>
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
      << " minutes; cameras "
      << (recording->cameras ? "too, the newest " + std::to_string(recording->camera_limit_bytes >> 30) + " GiB of each"
                             : std::string("not"))
      << "\n";
}

void describe_target(std::ostream& out, const TargetConfig& target) {
  out << "target " << target.name << ":\n  port: " << target.port;
  if (!target.is_replay()) out << " at " << target.baud << " baud";
  if (target.identity.serial) {
    std::array<char, 9> serial{};
    std::snprintf(serial.data(), serial.size(), "%08X", *target.identity.serial);
    out << "\n  must be the board with serial number " << serial.data();
  }
  if (target.identity.sensors) out << "\n  must be a board of " << *target.identity.sensors << " sensors";
  out << "\n  sensors: " << target.shape.sensors << " from " << target.target_file.string();
  if (target.shape.coplanar) out << " (all in one plane: single cycles may fit two poses)";
  if (target.generation == 2) {
    out << "\n  stations: " << target.stations.size() << " of Lighthouse 2.0, from " << target.stations_file.string()
        << ", poses in the world\n";
    return;
  }
  if (!target.calibration_file.empty()) {
    out << "\n  calibrated: " << target.calibrated_stations.size() << " stations and the sensors, from "
        << target.calibration_file.string() << ", size known to " << 100.0 * target.scale_sigma << " %";
  }
  out << "\n  method: "
      << (target.method == TrackMethod::kMotion ? "motion, a pose a sweep" : "epoch, each cycle alone")
      << (target.calibrated_pair ? ", the stations' relative pose from the calibration" : "");
  out << "\n  solve: sigma " << target.track.solve.sigma_rad * kArcsecPerRad << " arcsec, rho "
      << target.track.solve.rho << ", station model form " << static_cast<int>(target.track.form)
      << ", smoothed flashes: " << yes_no(target.track.smooth_flashes) << ", prior younger than "
      << target.track.prior_max_age_s << " s, poses of at most " << target.limits.rotation_rad * kDegPerRad
      << " deg and " << target.limits.position_m * kMmPerM
      << " mm (1 sigma, method motion)\n  remembers calibrations: " << yes_no(target.remember_calibrations) << '\n';
}

// What is known of ring and connectors beforehand.
void describe_ring(std::ostream& out, const TofConfig& camera) {
  const tof::TofSettings& tof = camera.tof;
  out << "\n  ring: outer radius " << tof.ring.min_outer_radius_m << " to " << tof.ring.max_outer_radius_m
      << " m, connectors: ";
  if (tof.target.stated()) {
    out << tof.target.connectors.size() << " described";
  } else {
    out << tof.connector.expected << ", the nearest gives the turn";
  }
  if (!camera.target_file.empty()) out << ", from " << camera.target_file.string();
}

void describe_camera(std::ostream& out, const TofConfig& camera) {
  const CameraSettings& device = camera.device;
  out << "camera " << camera.name << " (target " << camera.target << "):\n  ";
  if (camera.is_recorded()) {
    out << "frames: " << camera.frames.string();
  } else {
    out << "device:" << (device.serial.empty() ? "" : " serial number " + device.serial)
        << (device.address.empty() ? "" : " at " + device.address) << ", "
        << (device.mode.empty() ? "mode as the camera has it" : device.mode) << ", packets of " << device.packet_size
        << ", follows PTP: " << yes_no(device.ptp);
  }
  if (device.frame_rate_hz > 0.0) out << ", " << device.frame_rate_hz << " frames/s";
  out << "\n  lens: " << camera.camera.intrinsics.width_px << " x " << camera.camera.intrinsics.height_px
      << " pixels from " << camera.camera_file.string();
  describe_ring(out, camera);
  out << "\n  poses: "
      << (camera.average_frames == 1 ? "of every frame"
                                     : "means of " + std::to_string(camera.average_frames) + " frames")
      << '\n';
}

const char* describe_low_light(LowLight light) {
  switch (light) {
    case LowLight::kOff:
      return "as they come";
    case LowLight::kBm3d:
      return "enhanced, denoiser bm3d";
    case LowLight::kFast:
      return "enhanced, denoiser fast";
    case LowLight::kNotDenoised:
      return "enhanced, not denoised";
  }
  return "as they come";
}

void describe_stereo(std::ostream& out, const StereoConfig& stereo) {
  out << "stereo " << stereo.name << " (target " << stereo.target << "):\n  ";
  const double rate_hz = stereo.devices[0].frame_rate_hz;
  if (stereo.is_recorded()) {
    out << "pairs: " << stereo.frames.string();
  } else {
    for (std::size_t side = 0; side < stereo.devices.size(); ++side) {
      const CameraSettings& device = stereo.devices[side];
      out << (side == 0 ? "left:" : ", right:") << (device.serial.empty() ? "" : " serial number " + device.serial)
          << (device.address.empty() ? "" : " at " + device.address);
    }
    const CameraSettings& device = stereo.devices[0];
    out << ", " << (device.format == CameraFormat::kMono8 ? "Mono8" : "Mono16") << ", packets of " << device.packet_size
        << ", follow PTP: " << yes_no(device.ptp) << "\n  pairs: frames within " << stereo.pairing_window_s * 1e3
        << " ms";
  }
  if (rate_hz > 0.0) out << ", " << rate_hz << " frames/s";
  out << "\n  rig: " << stereo.rig.left.intrinsics.width_px << " x " << stereo.rig.left.intrinsics.height_px
      << " pixels from " << stereo.rig_file.string() << '\n';
  if (stereo.ring2) out << "  ring2: docking ring and nozzle of every pair\n";
  if (!stereo.slam) return;
  const slam::SlamSettings& slam = stereo.slam->settings;
  out << "  slam: scene " << name_of(slam.scene) << ", "
      << (slam.features > 0 ? std::to_string(slam.features) + " features, " : "features by the images' size, ")
      << (slam.max_keyframes == 0 ? "keyframes without limit"
                                  : "at most " + std::to_string(slam.max_keyframes) + " keyframes")
      << ", closes loops: " << yes_no(slam.close_loops) << ", vocabulary "
      << (slam.vocabulary.empty() ? "as it ships" : slam.vocabulary) << ", images "
      << describe_low_light(stereo.slam->enhance) << '\n';
}

void describe_telescope(std::ostream& out, const PointingConfig& telescope) {
  out << "telescope " << telescope.name << " (target " << telescope.target
      << "):\n  images: " << telescope.directory.string() << ", track " << telescope.track_file.string()
      << "\n  lens: " << telescope.camera.width_px << " x " << telescope.camera.height_px << " pixels from "
      << telescope.camera_file.string() << "\n  station: latitude " << telescope.station.latitude_rad * kDegPerRad
      << " deg, longitude " << telescope.station.longitude_rad * kDegPerRad << " deg, height "
      << telescope.station.height_m << " m\n  pass: ";
  if (telescope.law) {
    out << "law " << pointing::name_of(*telescope.law) << ", ends after " << telescope.pass_gap_s
        << " s without an image\n";
  } else {
    out << "not told (law = \"none\")\n";
  }
}

void describe_remote(std::ostream& out, const RemoteConfig& remote) {
  out << "remote " << remote.name << " (target " << remote.target << "):\n  poses: " << remote.source << " in "
      << remote.frame << " on " << remote.channel;
  if (remote.rate_hz > 0.0) out << ", " << remote.rate_hz << " /s";
  out << "\n  clock: ";
  if (remote.clock_sigma_s) {
    out << "held together elsewhere, sigma " << *remote.clock_sigma_s * 1e3 << " ms";
  } else {
    out << "compared with " << remote.daemon << "'s by round trips";
  }
  out << "\n  younger than " << remote.max_age_s << " s, silent after " << remote.silent_after_s << " s\n";
}

// Each fused source has a line of its own, so that a mounting that changed is seen in it.
void describe_vehicle(std::ostream& out, const VehicleConfig& vehicle) {
  const FusionChoices& fusion = vehicle.fusion;
  out << "vehicle (target " << vehicle.target << "):\n  mounting: " << vehicle.mounting_file.string()
      << "\n  states: " << vehicle.rate_hz << " /s and one for every measurement\n  motion: " << fusion.motion;
  if (fusion.motion == "orbit" || fusion.motion == "tumbling_orbit") {
    out << ", mean motion " << fusion.mean_motion_rad_s << " rad/s";
  }
  if (fusion.motion == "tumbling" || fusion.motion == "tumbling_orbit") {
    out << ", moments of inertia " << fusion.inertia[0] << " : " << fusion.inertia[1] << " : " << fusion.inertia[2];
  }
  out << ", acceleration density " << fusion.acceleration_density << " m^2/s^3, angular "
      << fusion.angular_acceleration_density << " rad^2/s^3\n  sources' own slow error: " << fusion.bias_deg << " deg, "
      << fusion.bias_mm << " mm over " << fusion.bias_time_s << " s\n  protection level: risk " << fusion.risk_per_hour
      << " per hour, faults " << fusion.faults_per_hour << " per hour of each kind and source\n";
  for (const FusedSourceConfig& source : vehicle.sources) {
    const auto& [x, y, z] = source.mounting.T_vehicle_sensor.position_m;
    out << "  fuses: " << source.mounting.name << " from " << source.source
        << (source.station.empty() ? "" : ", station " + source.station) << ", at " << x << ' ' << y << ' ' << z << " m"
        << (source.mounting.T_target_feature ? "" : ", tells changes only") << '\n';
  }
  for (const std::string& name : vehicle.not_configured) {
    out << "  not configured here: " << name << " of the mounting file\n";
  }
  for (const std::string& name : vehicle.not_mounted) out << "  not fused, as it has no mounting: " << name << '\n';
}

}  // namespace

std::string describe(const DaemonConfig& config) {
  std::ostringstream out;
  const std::string& prefix = config.lcm.channel_prefix;
  out << "source: " << config.source << "\nlcm: " << config.lcm.url << ", channels ";
  if (!config.targets.empty()) {
    out << prefix << "LIGHTHOUSE_POSE, " << (config.publish.bearings ? prefix + "LIGHTHOUSE_BEARINGS, " : "");
  }
  if (!config.cameras.empty()) out << prefix << "TOF_POSE, ";
  const auto any = [&config](const auto& has) {
    return std::any_of(config.stereos.begin(), config.stereos.end(), has);
  };
  if (any([](const StereoConfig& stereo) { return stereo.ring2; })) out << prefix << "RING2_POSE, ";
  if (any([](const StereoConfig& stereo) { return stereo.slam.has_value(); })) out << prefix << "SLAM_POSE, ";
  if (!config.telescopes.empty()) out << prefix << "LINE_POINTING, ";
  if (config.vehicle) out << prefix << "TARGET_STATE, ";
  if (config.publish.previews) out << prefix << "PREVIEW, ";
  if (config.lcm.answer_clock || !config.remotes.empty()) out << config.lcm.clock_channel << ", ";
  out << prefix << "STATUS\npublish: poses younger than " << config.publish.max_age_s << " s, status every "
      << config.publish.status_period_s << " s\nstate directory: "
      << (config.state_directory.empty() ? "none: calibrations are forgotten at a restart"
                                         : config.state_directory.string())
      << '\n';
  if (config.lcm.answer_clock) out << "answers daemons that compare their clocks with this one's\n";
  describe_recording(out, config.recording);
  describe_log(out, config.log);
  for (const TargetConfig& target : config.targets) describe_target(out, target);
  for (const TofConfig& camera : config.cameras) describe_camera(out, camera);
  for (const StereoConfig& stereo : config.stereos) describe_stereo(out, stereo);
  for (const PointingConfig& telescope : config.telescopes) describe_telescope(out, telescope);
  for (const RemoteConfig& remote : config.remotes) describe_remote(out, remote);
  if (config.vehicle) describe_vehicle(out, *config.vehicle);
  return out.str();
}

}  // namespace pharos::host
