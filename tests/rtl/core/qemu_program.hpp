// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace pharos::rtl {

/// Where QEMU's machine `virt` has memory, a UART and the register that ends it.
inline constexpr std::uint32_t kQemuMemory = 0x80000000;
inline constexpr std::uint32_t kQemuUart = 0x10000000;
inline constexpr std::uint32_t kQemuEnd = 0x00100000;
inline constexpr std::uint32_t kScratchOffset = 0x100000;  // data, after the code
inline constexpr std::uint32_t kScratchBytes = 4096;

/// A random program that writes all registers to the UART after every block of instructions, cause and state at each
/// trap, and its memory at the end. x28 to x31 are its own.
std::vector<std::uint32_t> qemu_program(std::uint64_t seed, std::uint32_t blocks, std::uint32_t block_instructions);

}  // namespace pharos::rtl
