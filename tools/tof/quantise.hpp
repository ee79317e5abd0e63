// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace pharos::tools {

/// What paper 000 does to depth: the frame's own span, nearest to farthest, in 2^bits grey values. Pixels without depth
/// stay so.
void quantise_depth(std::span<std::uint16_t> depth, int bits);

}  // namespace pharos::tools
