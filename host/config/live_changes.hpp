// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// Whether two configurations of one target know the same of its sensors and stations.
bool same_calibration(const TargetConfig& a, const TargetConfig& b);
/// Sensor positions, stations and systematic errors of `from`, with the file that told them.
void take_calibration(const TargetConfig& from, TargetConfig& to);

/// Takes over from `fresh` what a running daemon can change: the log's level, [publish], the calibrations of its
/// targets. Returns what else differs, one line of describe() each: that needs a restart.
std::vector<std::string> take_live_changes(const DaemonConfig& fresh, DaemonConfig& config);

}  // namespace pharos::host
