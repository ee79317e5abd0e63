// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::host {

/// How fast a recording is played.
enum class ReplaySpeed : std::uint8_t { kReal, kFastest };

}  // namespace pharos::host
