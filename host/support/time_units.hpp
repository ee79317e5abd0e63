// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::host {

inline constexpr std::int64_t kNsPerSecond = 1'000'000'000;
inline constexpr std::int64_t kNsPerUs = 1000;

}  // namespace pharos::host
