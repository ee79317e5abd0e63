// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::board {

/// Bytes of the stack that the image reserved (__stack_size).
std::uint32_t stack_bytes();
/// Bytes of it that were never written since start: start.S filled all with one word. Overestimates at most by words
/// that were reserved and left unwritten. Cost: a read a word.
std::uint32_t stack_never_used_bytes();

}  // namespace pharos::board
