// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "host/daemon/rolling_count.hpp"
#include "host/publish/health.hpp"

namespace pharos::host {

/// Below these fractions of what was expected a source is degraded, and in error.
inline constexpr double kDegradedBelow = 0.9;
inline constexpr double kErrorBelow = 0.5;

/// One stage of what a source delivers, for people too.
struct DeliveryStage {
  const char* what = "";   // frames, sweeps, poses
  const char* where = "";  // what to look at where they are missing
  DeliveryCount count;
};

struct DeliveryAssessment {
  SourceState state = SourceState::kOk;  // kOk, kDegraded or kError
  std::string message;                   // the least part that came of what was expected; empty when ok
};

/// `stages` from the wire upwards: what is lost below is missing above as well, so the first of those that are low is
/// the cause.
DeliveryAssessment assess_delivery(std::initializer_list<DeliveryStage> stages);

}  // namespace pharos::host
