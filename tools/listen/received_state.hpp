// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/listen/received_pose.hpp"

namespace pharos {
class target_state_t;
}

namespace pharos::tools {

/// A fused state as it arrived on `channel` at `utc_ns`: its pose, status the mode, flags what is not believed
/// (`tof:excluded:step`, `tof:conflict`), and what else it tells in `fused`. Its source is "fusion".
ReceivedPose received_state(const std::string& channel, const target_state_t& message, std::int64_t utc_ns);

/// "protected to 12.3 mm 0.45 deg  lighthouse used, tof excluded (step)", for people.
std::string fused_text(const FusedReading& fused);

/// The whole message as one JSON object; fields without a value in a state that is not valid are null.
std::string state_json(const target_state_t& message);

}  // namespace pharos::tools
