// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_remote.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "host/config/config_parts.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kMaxRemotes = 16;
constexpr double kMsPerS = 1e3;

// KIND/NAME as in the messages; lighthouse/NAME has the daemon's name.
void read_source(const TomlTable& table, RemoteConfig& remote) {
  const std::string source = table.text("source");
  const std::size_t slash = source.find('/');
  const std::optional<SourceKind> kind = source_kind(source.substr(0, slash));
  if (slash == std::string::npos || !kind) {
    table.fail("source", "must be as in its messages: lighthouse/, tof/, ring2/ or slam/ and a name");
  }
  read_name(table, "source", source.substr(slash + 1));
  remote.source = source;
  remote.kind = *kind;
}

void read_frames(const TomlTable& table, RemoteConfig& remote) {
  const bool lighthouse = remote.kind == SourceKind::kLighthouse;
  remote.feature = lighthouse ? "body" : "target";
  remote.frame = remote.kind == SourceKind::kRing2 ? "rig" : "camera";
  if (lighthouse) {
    remote.frame = table.choice_or("frame", "lighthouse", {"lighthouse", "world"});
  } else if (table.has("frame")) {
    table.fail("frame", "is of a lighthouse alone (lighthouse or world); leave it out");
  }
}

void read_clock(const TomlTable& table, const DaemonConfig& config, RemoteConfig& remote) {
  if (table.has("clock_sigma_ms")) {
    remote.clock_sigma_s = table.number("clock_sigma_ms", {1e-4, 1e3}) / kMsPerS;
  }
  if (!table.has("daemon")) {
    if (remote.clock_sigma_s) return;
    table.fail("daemon",
               "is missing: `source` of the other daemon's configuration, whose clock is to be compared (there: "
               "lcm.answer_clock = true); or clock_sigma_ms, where PTP or NTP holds both clocks together");
  }
  if (remote.clock_sigma_s) table.fail("daemon", "and clock_sigma_ms exclude each other: remove one");
  remote.daemon = read_name(table, "daemon", table.text("daemon"));
  if (remote.daemon == config.source) {
    table.fail("daemon", "\"" + remote.daemon + "\" is this daemon's own name; give each a `source` of its own");
  }
}

RemoteConfig read_remote(const TomlTable& table, const DaemonConfig& config, ConfigErrors& errors) {
  RemoteConfig remote;
  errors.attempt([&] { remote.name = read_name(table, "name", table.text("name")); });
  errors.attempt([&] { remote.channel = read_channel(table, "channel", table.text("channel")); });
  const bool knows_kind = errors.attempt([&] { read_source(table, remote); });
  errors.attempt([&] { remote.target = read_name(table, "target", table.text("target")); });
  if (knows_kind) {
    errors.attempt([&] { read_frames(table, remote); });
  } else {
    static_cast<void>(table.has("frame"));
  }
  errors.attempt([&] { read_clock(table, config, remote); });
  errors.attempt([&] { remote.rate_hz = table.number_or("rate_hz", remote.rate_hz, {0.0, 1000.0}); });
  errors.attempt([&] { remote.max_age_s = table.number_or("max_age_s", remote.max_age_s, {0.005, 10.0}); });
  errors.attempt([&] {
    remote.silent_after_s = table.number_or("silent_after_s", remote.silent_after_s, {0.05, 60.0});
  });
  errors.add_unknown_keys(table);
  return remote;
}

// Channel and source of what this daemon publishes itself.
bool is_own(const RemoteConfig& remote, const DaemonConfig& config) {
  const std::string& prefix = config.lcm.channel_prefix;
  const auto is = [&](const char* channel, const std::string& source) {
    return remote.channel == prefix + channel && remote.source == source;
  };
  const auto stereo = [&](const StereoConfig& rig) {
    return (rig.ring2 && is("RING2_POSE", "ring2/" + rig.name)) || (rig.slam && is("SLAM_POSE", "slam/" + rig.name));
  };
  return (!config.targets.empty() && is("LIGHTHOUSE_POSE", "lighthouse/" + config.source)) ||
         std::any_of(config.cameras.begin(), config.cameras.end(),
                     [&](const TofConfig& camera) { return is("TOF_POSE", "tof/" + camera.name); }) ||
         std::any_of(config.stereos.begin(), config.stereos.end(), stereo);
}

}  // namespace

std::vector<RemoteConfig> read_remotes(const TomlTable& root, const DaemonConfig& config, ConfigErrors& errors) {
  std::vector<RemoteConfig> remotes;
  std::set<std::string> names;
  std::set<std::pair<std::string, std::string>> streams;
  for (const TomlTable& table : root.tables("remote")) {
    remotes.push_back(read_remote(table, config, errors));
    const RemoteConfig& remote = remotes.back();
    errors.attempt([&] {
      if (!remote.name.empty() && !names.insert(remote.name).second) {
        table.fail("name", "\"" + remote.name + "\" is taken by another remote");
      }
    });
    errors.attempt([&] {
      if (remote.channel.empty() || remote.source.empty()) return;
      if (is_own(remote, config)) table.fail("source", "\"" + remote.source + "\" is a source of this daemon itself");
      if (!streams.insert({remote.channel, remote.source + ' ' + remote.target}).second) {
        table.fail("source", "\"" + remote.source + "\" on this channel is taken by another remote");
      }
    });
    errors.attempt([&] {
      if (config.lcm.url.rfind("file:", 0) == 0) table.fail("channel", "cannot be received: lcm.url writes a file");
      if (remotes.size() > kMaxRemotes) table.fail("name", "is one of more than " + std::to_string(kMaxRemotes));
    });
  }
  return remotes;
}

}  // namespace pharos::host
