// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/publish/cycle_report.hpp"
#include "host/publish/health.hpp"
#include "host/publish/pointing_report.hpp"
#include "host/publish/spin_report.hpp"
#include "host/publish/stereo_report.hpp"
#include "host/publish/tof_report.hpp"
#include "pharos/bearings_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"

namespace pharos::host {

// The daemon's values as LCM types: SI, times in microseconds, fields that do not apply are 0. Refusals contain no
// numbers.

pose_t message_of(const CycleReport& report);
pose_t message_of(const WorldPoseReport& report);
pose_t message_of(const TofReport& report);
pose_t message_of(const StereoReport& report);
pointing_t message_of(const PointingReport& report);
spin_t message_of(const SpinReport& report);
bearings_t message_of(const BearingsReport& report);
status_t status_message(const DaemonHealth& health, std::int64_t sequence);

/// All fields of a pose's message but the pose itself, from its header.
pose_t pose_message_of(const MeasurementHeader& header);

}  // namespace pharos::host
