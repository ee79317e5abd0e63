// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/fusion/fusion_settings.hpp"
#include "host/mounting/mounting.hpp"

namespace pharos::host {

/// One source of the fused state: where it is mounted, and whose messages are its poses.
struct FusedSourceConfig {
  SourceMounting mounting;
  /// `source` of its messages without what the daemon's own name and a replay add: "lighthouse", "tof/NAME", …; of
  /// another daemon's "remote/NAME".
  std::string source;
  /// Lighthouse: the station in whose frame the mounting is, as eight hex digits; empty: the only one seen.
  std::string station;
  bool is_remote = false;
};

/// The vehicle: all sources' poses of one target become one state in its frame.
struct VehicleConfig {
  std::filesystem::path mounting_file;
  /// Name of the target, part of every message; that of all fused sources.
  std::string target;
  /// States a second, in addition to one for every measurement.
  double rate_hz = 20.0;
  FusionChoices fusion;
  std::vector<FusedSourceConfig> sources;  // 1 to fusion::kMaxSources
  /// Sources of the mounting file that are not configured here, and sources configured here that it does not have.
  std::vector<std::string> not_configured;
  std::vector<std::string> not_mounted;
};

}  // namespace pharos::host
