// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pharos/signature/sha2.hpp"
#include "pharos/wire/command_message.hpp"

namespace pharos::boot {

/// The reason for the host, or 0.
enum class Verdict : std::uint8_t {
  kGood = 0,
  kBad = static_cast<std::uint8_t>(wire::NakReason::kBadSignature),
  kNoVerifier = static_cast<std::uint8_t>(wire::NakReason::kNoVerifier),
};

/// Where the verifier is linked to, the first bytes of the on-chip memory (verifier.ld): the image that was loaded
/// there is overwritten.
inline constexpr std::uint32_t kVerifierAddress = 0x80001000;
inline constexpr std::uint32_t kMaxVerifierBytes = 8 * 1024;

/// Copies the verifier from the flash, checks that it is the one that this loader was built with, and calls it.
template <class Flash>
Verdict verify_in_memory(std::uint32_t flash_offset, std::span<const std::uint8_t, 32> verifier_sha256,
                         std::uint32_t verifier_bytes, std::span<const std::uint8_t> message,
                         const std::uint8_t* signature) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): an address of the memory map
  const std::span code(reinterpret_cast<std::uint8_t*>(kVerifierAddress), verifier_bytes);
  Flash::read(flash_offset, code);
  if (!signature::is_sha256(verifier_sha256, code)) return Verdict::kNoVerifier;
  // The data just written is executed next.
  asm volatile(".option push\n.option arch, +zifencei\nfence.i\n.option pop" ::: "memory");
  using Verifier = std::uint32_t (*)(const std::uint8_t* signature, const std::uint8_t* message, std::uint32_t bytes);
  const auto verifier = reinterpret_cast<Verifier>(kVerifierAddress);  // NOLINT(performance-no-int-to-ptr)
  return verifier(signature, message.data(), static_cast<std::uint32_t>(message.size())) == 1 ? Verdict::kGood
                                                                                              : Verdict::kBad;
}

}  // namespace pharos::boot
