// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/mounting/mounting.hpp"

namespace pharos::host {

/// A pose channel of another daemon, as a source of the fusion.
struct RemoteConfig {
  /// Part of the status, as `remote/NAME`; unique among the remotes.
  std::string name;
  /// LCM channel with its prefix.
  std::string channel;
  /// What its messages must have in order to be believed: `source`, whose beginning tells the kind, `target`, the
  /// frames.
  std::string source;
  SourceKind kind = SourceKind::kTof;
  std::string target;
  std::string frame;    // parent_frame
  std::string feature;  // child_frame
  /// `source` of the other daemon's configuration, whose clock is compared with this one's by round trips.
  std::string daemon;
  /// 1 sigma of the two clocks' difference, s, where something else holds them together (PTP, NTP); empty: measured.
  std::optional<double> clock_sigma_s;
  /// Poses per second that are expected; 0: any.
  double rate_hz = 0.0;
  /// Poses whose measurement is older when they come are not used.
  double max_age_s = 0.5;
  /// Without a message for longer it is silent.
  double silent_after_s = 1.0;
};

}  // namespace pharos::host
