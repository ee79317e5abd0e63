// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/publish/measurement_header.hpp"
#include "pharos/fusion/target_state.hpp"
#include "pharos/target_state_t.hpp"

namespace pharos::host {

/// Context that the fused state itself does not have.
struct TargetStateHeader {
  std::int64_t utc_ns = 0;  // of the state's time
  std::int64_t sequence = 0;
  std::string target;
  std::vector<std::string> sources;  // names by index
  double risk_per_hour = 0.0;
};

/// The message of a state; a state whose values are not all finite becomes one that is not valid.
target_state_t message_of(const fusion::TargetState& state, const TargetStateHeader& header);

/// The fused state as PublishGate takes it. Its refusal is the mode where there is no state (searching, lost).
struct TargetStateReport : MeasurementHeader {
  TargetStateReport() { frames = {"vehicle", "target"}; }

  fusion::TargetState state;
  std::vector<std::string> names;  // of the sources
  double risk_per_hour = 0.0;
};

const char* channel_of(const TargetStateReport& report);
bool is_finite(const TargetStateReport& report);
target_state_t message_of(const TargetStateReport& report);

}  // namespace pharos::host
