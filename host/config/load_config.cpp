// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_config.hpp"

#include <charconv>
#include <map>
#include <set>
#include <sstream>

#include "host/config/config_errors.hpp"
#include "host/config/config_parts.hpp"
#include "host/config/lcm_url.hpp"
#include "host/config/load_pointing.hpp"
#include "host/config/load_remote.hpp"
#include "host/config/load_stereo.hpp"
#include "host/config/load_tof.hpp"
#include "host/config/load_vehicle.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPrefix = 40;  // leaves 23 of LCM's 63 characters for the channel's own name
constexpr double kMebibyte = 1 << 20;
constexpr double kGibibyte = 1 << 30;
constexpr double kSecondsPerMinute = 60.0;

LcmConfig read_lcm(const TomlTable& table, ConfigErrors& errors) {
  LcmConfig lcm;
  errors.attempt([&] {
    lcm.url = table.text_or("url", lcm.url);
    if (const std::string error = lcm_url_error(lcm.url); !error.empty()) table.fail("url", error);
  });
  errors.attempt([&] {
    lcm.channel_prefix = table.text_or("channel_prefix", lcm.channel_prefix);
    if (lcm.channel_prefix.size() > kMaxPrefix || !all_of_set(lcm.channel_prefix, "_")) {
      table.fail("channel_prefix", "must be at most " + std::to_string(kMaxPrefix) + " letters, digits or _");
    }
  });
  errors.attempt([&] {
    lcm.clock_channel = read_channel(table, "clock_channel", table.text_or("clock_channel", lcm.clock_channel));
  });
  errors.attempt([&] {
    lcm.answer_clock = table.boolean_or("answer_clock", lcm.answer_clock);
    if (lcm.answer_clock && lcm.url.rfind("file:", 0) == 0) {
      table.fail("answer_clock", "cannot be: with this url nothing is received");
    }
  });
  return lcm;
}

PublishConfig read_publish(const TomlTable& table, ConfigErrors& errors) {
  PublishConfig publish;
  errors.attempt([&] { publish.max_age_s = table.number_or("max_age_s", publish.max_age_s, {0.005, 10.0}); });
  errors.attempt([&] {
    publish.status_period_s = 1.0 / table.number_or("status_rate_hz", 1.0 / publish.status_period_s, {0.1, 10.0});
  });
  errors.attempt([&] { publish.bearings = table.boolean_or("bearings", publish.bearings); });
  errors.attempt([&] { publish.previews = table.boolean_or("previews", publish.previews); });
  return publish;
}

RecordingConfig read_recording(const TomlTable& table, const fs::path& folder, ConfigErrors& errors) {
  RecordingConfig recording;
  errors.attempt([&] { recording.directory = read_path(table, "directory", folder); });
  errors.attempt([&] {
    const double default_mib = static_cast<double>(recording.rotate_bytes) / kMebibyte;
    recording.rotate_bytes =
        static_cast<std::uint64_t>(table.number_or("rotate_mib", default_mib, {0.01, 65'536.0}) * kMebibyte);
  });
  errors.attempt([&] {
    recording.rotate_s =
        table.number_or("rotate_minutes", recording.rotate_s / kSecondsPerMinute, {0.01, 10'080.0}) * kSecondsPerMinute;
  });
  errors.attempt([&] { recording.cameras = table.boolean_or("cameras", recording.cameras); });
  errors.attempt([&] {
    const double default_gib = static_cast<double>(recording.camera_limit_bytes) / kGibibyte;
    recording.camera_limit_bytes =
        static_cast<std::uint64_t>(table.number_or("camera_limit_gib", default_gib, {0.1, 1e6}) * kGibibyte);
  });
  return recording;
}

LogConfig read_log(const TomlTable& table, const fs::path& folder, ConfigErrors& errors) {
  LogConfig log;
  errors.attempt([&] {
    log.level = table.choice_or("level", log.level, {"trace", "debug", "info", "warning", "error", "critical", "off"});
  });
  const bool has_file = table.has("file");
  const bool knows_sink = errors.attempt([&] {
    const std::string sink = table.choice_or("sink", "stderr", {"stderr", "syslog", "file"});
    if (sink == "syslog") log.sink = LogSink::kSyslog;
    if (sink == "file") log.sink = LogSink::kFile;
  });
  if (!knows_sink) return log;
  errors.attempt([&] {
    if (log.sink == LogSink::kFile) {
      log.file = read_path(table, "file", folder);
    } else if (has_file) {
      table.fail("file", "is used only with sink = \"file\"; set that or remove this key");
    }
  });
  return log;
}

track::TrackOptions read_solve(const TomlTable& table, ConfigErrors& errors) {
  track::TrackOptions options;
  errors.attempt([&] {
    options.solve.sigma_rad =
        table.number_or("sigma_arcsec", options.solve.sigma_rad * kArcsecPerRad, {0.1, 3600.0}) * kRadPerArcsec;
  });
  errors.attempt([&] { options.solve.rho = table.number_or("rho", options.solve.rho, {0.0, 0.999}); });
  errors.attempt([&] {
    options.form =
        table.integer_or("model_form", 1, 1, 2) == 1 ? lighthouse::ModelForm::kForm1 : lighthouse::ModelForm::kForm2;
  });
  errors.attempt([&] { options.smooth_flashes = table.boolean_or("smooth_flashes", options.smooth_flashes); });
  errors.attempt([&] {
    options.prior_max_age_s = table.number_or("prior_max_age_s", options.prior_max_age_s, {0.0, 60.0});
  });
  return options;
}

motion::UncertaintyLimits read_limits(const TomlTable& table, ConfigErrors& errors) {
  motion::UncertaintyLimits limits;
  errors.attempt([&] {
    limits.rotation_rad =
        table.number_or("largest_sigma_deg", limits.rotation_rad * kDegPerRad, {0.001, 180.0}) * kRadPerDeg;
  });
  errors.attempt([&] {
    limits.position_m = table.number_or("largest_sigma_mm", limits.position_m * kMmPerM, {0.01, 1e4}) / kMmPerM;
  });
  return limits;
}

std::uint32_t read_serial(const TomlTable& table) {
  constexpr std::size_t kDigits = 8;
  const std::string serial = table.text("serial");
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(serial.data(), serial.data() + serial.size(), value, 16);
  if (serial.size() != kDigits || error != std::errc{} || end != serial.data() + kDigits || value == 0) {
    table.fail("serial", "must be the board's number as eight hex digits, as `pharos listen PHAROS_STATUS` shows it");
  }
  return value;
}

ExpectedIdentity read_identity(const TomlTable& table, ConfigErrors& errors) {
  ExpectedIdentity identity;
  errors.attempt([&] {
    if (table.has("serial")) identity.serial = read_serial(table);
  });
  errors.attempt([&] {
    if (!table.has("sensors")) return;
    identity.sensors = static_cast<int>(table.integer_or("sensors", 0, 1, static_cast<std::int64_t>(kMaxSensors)));
  });
  return identity;
}

// Calibrated sensor positions and stations.
void read_calibration(const TomlTable& table, const fs::path& folder, const Environment& environment,
                      TargetConfig& target) {
  target.calibration_file = read_path(table, "calibration_file", folder);
  try {
    const calibrate::CalibrationFile file = environment.read_calibration(target.calibration_file.string());
    target.target = calibrate::calibrated_target(file, target.target);
    target.scale_sigma = file.scale_sigma;
    target.systematic = calibrate::systematic_errors(file);
    target.calibrated_pair = file.pair;
    for (const StationEntry& station : file.stations) {
      if (!station.id) throw InputError(file.name + ": a [[station]] without id; the daemon knows stations by theirs");
      target.calibrated_stations.push_back({station.id, std::nullopt, station.calibration});
    }
    if (file.model_form != 0 && file.model_form != static_cast<int>(target.track.form)) {
      throw InputError(file.name + ": calibrated with sign form " + std::to_string(file.model_form) +
                       "; set solve.model_form to it");
    }
  } catch (const InputError& error) {
    table.fail("calibration_file", error.what());
  }
}

void read_port(const TomlTable& table, const fs::path& folder, const Environment& environment, TargetConfig& target) {
  target.port = table.text("port");
  if (target.port.empty() || target.port.find('\0') != std::string::npos) {
    table.fail("port", "must be a terminal device (/dev/…) or replay:FILE");
  }
  if (!target.is_replay()) return;
  if (target.replay_file().is_relative()) {
    target.port = TargetConfig::kReplayPrefix + (folder / target.replay_file()).string();
  }
  try {
    environment.check_recording(target.replay_file(), target.name);
  } catch (const InputError& error) {
    table.fail("port", error.what());
  }
}

void read_target_file(const TomlTable& table, const fs::path& folder, const Environment& environment,
                      TargetConfig& target) {
  target.target_file = read_path(table, "target_file", folder);
  try {
    const TargetFile file = environment.read_target(target.target_file.string());
    target.target = file.target;
    target.shape = file.shape;
  } catch (const InputError& error) {
    table.fail("target_file", error.what());
  }
}

// Stations of Lighthouse 2.0: the room's, with their poses. What belongs to Lighthouse 1.0 alone is refused.
void read_room(const TomlTable& table, const fs::path& folder, const Environment& environment, TargetConfig& target) {
  target.generation = static_cast<int>(table.integer_or("generation", 1, 1, 2));
  if (target.generation == 1) {
    if (table.has("stations_file")) table.fail("stations_file", "is for generation = 2; leave it out or set that");
    return;
  }
  for (const char* key : {"calibration_file", "method", "solve", "remember_calibrations"}) {
    if (table.has(key)) table.fail(key, "is for generation 1; the stations of generation 2 are in stations_file");
  }
  target.stations_file = read_path(table, "stations_file", folder);
  try {
    target.stations = environment.read_stations(target.stations_file.string());
    for (const network::Station& station : target.stations) {
      const std::string name = target.stations_file.string() + ": station " + std::to_string(station.number);
      if (station.generation != network::Generation::kLighthouse2) throw InputError(name + " is of generation 1");
      if (!station.T_world_station) throw InputError(name + " has no position_m and rotation_wxyz; give or remove it");
    }
    if (target.stations.empty()) throw InputError(target.stations_file.string() + ": holds no [[station]]");
  } catch (const InputError& error) {
    table.fail("stations_file", error.what());
  }
}

TargetConfig read_target_table(const TomlTable& table, const fs::path& folder, const Environment& environment,
                               ConfigErrors& errors) {
  TargetConfig target;
  errors.attempt([&] { target.name = read_name(table, "name", table.text("name")); });
  errors.attempt([&] { read_port(table, folder, environment, target); });
  // Any rate is accepted: the port sets arbitrary rates (BOTHER), and opening it fails if the device does not.
  errors.attempt([&] { target.baud = static_cast<int>(table.integer_or("baud", target.baud, 1'200, 12'000'000)); });
  errors.attempt(
      [&] { target.remember_calibrations = table.boolean_or("remember_calibrations", target.remember_calibrations); });
  errors.attempt([&] { read_room(table, folder, environment, target); });
  errors.attempt([&] {
    const std::string method = table.choice_or("method", "motion", {"motion", "epoch"});
    target.method = method == "motion" ? TrackMethod::kMotion : TrackMethod::kEpoch;
  });
  const std::size_t before_solve = errors.count();
  errors.attempt([&] { target.track = read_solve(table.table_or_empty("solve"), errors); });
  const bool knows_form = errors.count() == before_solve;
  errors.attempt([&] { target.limits = read_limits(table.table_or_empty("solve"), errors); });
  errors.attempt([&] { target.identity = read_identity(table.table_or_empty("identity"), errors); });
  const bool knows_target = errors.attempt([&] { read_target_file(table, folder, environment, target); });
  // A calibration is checked against target and model form.
  if (table.has("calibration_file") && knows_target && knows_form) {
    errors.attempt([&] { read_calibration(table, folder, environment, target); });
  }
  errors.add_unknown_keys(table);
  return target;
}

std::vector<TargetConfig> read_targets(const TomlTable& root, const fs::path& folder, const Environment& environment,
                                       ConfigErrors& errors) {
  std::vector<TargetConfig> targets;
  std::set<std::string> names;
  std::map<std::string, std::string> ports;  // identity -> spelling
  const auto require_free = [&](const TomlTable& table, const TargetConfig& target) {
    errors.attempt([&] {
      if (target.name.empty() || names.insert(target.name).second) return;
      table.fail("name", "\"" + target.name + "\" is taken by another target");
    });
    const std::string path = target.is_replay() ? target.replay_file().string() : target.port;
    if (path.empty()) return;
    const auto [taken, is_free] = ports.emplace(environment.identity(path), target.port);
    if (is_free) return;
    errors.attempt([&, other = taken->second] {
      table.fail("port", "\"" + target.port + "\" is taken by another target" +
                             (other == target.port ? "" : ", as \"" + other + "\""));
    });
  };
  for (const TomlTable& table : root.tables("target")) {
    targets.push_back(read_target_table(table, folder, environment, errors));
    require_free(table, targets.back());
  }
  return targets;
}

/// With file and line, as every other error.
std::vector<PlaceError> located(std::vector<PlaceError> errors, const TomlTable& root) {
  for (PlaceError& error : errors) {
    const TomlTable table = error.table.empty() ? root : root.tables(error.table)[error.index];
    error.message = table.message_of(error.key, error.message);
  }
  return errors;
}

DaemonConfig read_root(const TomlTable& root, const fs::path& folder, const Environment& environment) {
  DaemonConfig config;
  ConfigErrors errors;
  errors.attempt([&] { config.source = read_name(root, "source", root.text_or("source", config.source)); });
  errors.attempt([&] {
    if (root.has("state_directory")) config.state_directory = read_path(root, "state_directory", folder);
  });
  errors.attempt([&] { config.lcm = read_lcm(root.table_or_empty("lcm"), errors); });
  errors.attempt([&] { config.publish = read_publish(root.table_or_empty("publish"), errors); });
  errors.attempt([&] {
    if (root.has("recording")) config.recording = read_recording(root.table("recording"), folder, errors);
  });
  errors.attempt([&] { config.log = read_log(root.table_or_empty("log"), folder, errors); });
  errors.attempt([&] { config.targets = read_targets(root, folder, environment, errors); });
  errors.attempt([&] { config.cameras = read_tof_cameras(root, folder, environment, errors); });
  errors.attempt([&] { config.telescopes = read_pointing(root, folder, environment, errors); });
  errors.attempt([&] { config.stereos = read_stereos(root, folder, environment, config.cameras, errors); });
  errors.attempt([&] { config.remotes = read_remotes(root, config, errors); });
  errors.attempt([&] { config.vehicle = read_vehicle(root, folder, environment, config, errors); });
  errors.add_unknown_keys(root);
  config.place_errors = located(environment.check_places(config), root);
  if (errors.count() > 0) {
    for (const PlaceError& error : config.place_errors) errors.add(error.message);
  }
  errors.throw_all();
  if (config.targets.empty() && config.cameras.empty() && config.telescopes.empty() && config.stereos.empty() &&
      config.remotes.empty()) {
    root.fail("target",
              "is missing; add a [[target]] with name, port and target_file, or a [[camera]] with name, target, "
              "camera_file and serial, or a [[stereo]], [[telescope]] or [[remote]]");
  }
  return config;
}

}  // namespace

DaemonConfig load_daemon_config(const fs::path& file) {
  return read_root(TomlTable::parse_file(file), file.parent_path(), host_environment());
}

DaemonConfig parse_daemon_config(std::string_view text, const std::string& name, const fs::path& folder,
                                 const Environment& environment) {
  return read_root(TomlTable::parse_text(text, name), folder, environment);
}

}  // namespace pharos::host
