// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos {

/// One of a station's two sweeps: x (the horizontal sweep, axis bit 0 of the flash code) or y (vertical, bit 1).
enum class Axis : std::uint8_t { kX = 0, kY = 1 };

inline constexpr int kAxes = 2;

constexpr int index_of(Axis axis) { return static_cast<int>(axis); }
constexpr char name_of(Axis axis) { return axis == Axis::kX ? 'x' : 'y'; }

}  // namespace pharos
