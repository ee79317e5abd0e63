// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tools/sources/source_table.hpp"

namespace pharos::tools {

enum class LightLevel : std::uint8_t {
  kUnknown,  // no message says it
  kGood,
  kDegraded,
  kBad,
};

/// One traffic light of a source, with its reason in words.
struct Light {
  LightLevel level = LightLevel::kUnknown;
  std::string reason;
};

/// The traffic lights of a source, in this order.
struct Lights {
  Light sees_light;      // data arrive
  Light calibrated;      // with the station's or camera's calibration
  Light geometry_known;  // the observations determine one pose, all of it
  Light estimate_good;   // the newest value is current and without a warning
};

/// What messages and daemon say of a source, as lights. `now_ns` as in SourceTable.
Lights lights_of(const SourceTable& table, const SourceKey& key, const SourceRow& row, std::int64_t now_ns);

/// "good", "degraded", "bad", "unknown".
const char* name_of(LightLevel level);

}  // namespace pharos::tools
