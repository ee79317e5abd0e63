// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/export/message_json.hpp"

namespace pharos::tools {

/// Kinds of topics.
enum class Topic : std::uint8_t {
  kPose,
  kTransform,
  kPoseInFrame,
  kPointing,
  kSpin,
  kStatus,
  kCounters,
  kBearings,
  kClock,
  kTargetState,
  kPreview,
  kImage
};
inline constexpr std::size_t kTopics = 12;

/// The schema's name: pharos.pose, ... or that of Foxglove's schema which readers know.
const char* schema_name(Topic topic);
/// JSON Schema of its messages: every field is required and no other is allowed.
Json schema_of(Topic topic);

}  // namespace pharos::tools
