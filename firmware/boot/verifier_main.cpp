// SPDX-License-Identifier: Apache-2.0
// PHAROS_PUBLIC_KEY: the 32 bytes of the key. Made by the build (signing.py).
#include <cstdint>
#include <cstring>

#include "pharos/signature/ed25519.hpp"

namespace {

constexpr pharos::signature::PublicKey kKey = {PHAROS_PUBLIC_KEY};

}  // namespace

/// 1: the 64 bytes are the key's signature of the message.
extern "C" std::uint32_t pharos_verifier(const std::uint8_t* signature, const std::uint8_t* message,
                                         std::uint32_t bytes) {
  pharos::signature::Signature copy;
  std::memcpy(copy.data(), signature, copy.size());
  return pharos::signature::verify(copy, kKey, {message, bytes}) ? 1 : 0;
}
