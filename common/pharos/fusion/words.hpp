// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/fusion/target_state.hpp"

namespace pharos::fusion {

/// Words of tables, messages and options.
inline constexpr std::array<const char*, 6> kModeWords = {"searching", "single",   "fused",
                                                          "conflict",  "coasting", "lost"};
inline constexpr std::array<const char*, 5> kSourceStateWords = {"silent", "used", "gated", "excluded", "conflict"};
inline constexpr std::array<const char*, kFaultKinds> kFaultWords = {
    "step", "ramp", "freeze", "wrong_time", "wrong_scale", "mirrored", "wrong_target", "outliers"};

inline const char* word_of(Mode mode) { return kModeWords[static_cast<std::size_t>(mode)]; }
inline const char* word_of(SourceState state) { return kSourceStateWords[static_cast<std::size_t>(state)]; }
inline const char* word_of(FaultKind kind) { return kFaultWords[static_cast<std::size_t>(kind)]; }

}  // namespace pharos::fusion
