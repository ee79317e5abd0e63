// SPDX-License-Identifier: Apache-2.0
// Any bytes as key, signature and message. An accepted signature is refused in another form and for a longer message.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "pharos/signature/ed25519.hpp"
#include "support/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos::signature;
  PublicKey key;
  Signature signature;
  if (size < key.size() + signature.size()) return 0;
  std::copy_n(data, key.size(), key.begin());
  std::copy_n(data + key.size(), signature.size(), signature.begin());
  const std::span message(data + key.size() + signature.size(), size - key.size() - signature.size());
  if (!verify(signature, key, message)) return 0;
  for (std::size_t bit = 256; bit < 512; ++bit) {
    Signature changed = signature;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1 << (bit % 8));
    pharos::test::require(!verify(changed, key, message));
  }
  return 0;
}
