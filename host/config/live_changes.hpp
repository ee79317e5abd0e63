// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// Whether two configurations of one target have the same calibration of sensors and stations.
bool same_calibration(const TargetConfig& a, const TargetConfig& b);
/// Copies sensor positions, stations and systematic errors of `from`, with the name of their file.
void take_calibration(const TargetConfig& from, TargetConfig& to);

/// Takes over from `fresh` what can change in a running daemon: the log's level, [publish], the calibrations of its
/// targets. Returns all other differences, which need a restart, one line of describe() each.
std::vector<std::string> take_live_changes(const DaemonConfig& fresh, DaemonConfig& config);

}  // namespace pharos::host
