// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pharos::signature {

/// SHA-256 (Word 32 bits) and SHA-512 (64 bits) of FIPS 180-4, for messages of less than 2^29 bytes given in any
/// parts. The constants of SHA-256 are the upper halves of those of SHA-512: one table.
template <class Word>
class Sha2 {
 public:
  static constexpr std::size_t kBlockBytes = 16 * sizeof(Word);
  using Digest = std::array<std::uint8_t, 8 * sizeof(Word)>;

  Sha2();
  /// The next part of the message.
  void add(std::span<const std::uint8_t> part);
  /// Ends the message; the object is of no further use.
  Digest finish();

 private:
  void put(std::uint8_t byte);
  void compress();

  std::array<Word, 8> state_;
  std::array<Word, 16> block_{};  // words as numbers
  std::uint32_t bytes_ = 0;
};

using Sha256 = Sha2<std::uint32_t>;
using Sha512 = Sha2<std::uint64_t>;

extern template class Sha2<std::uint32_t>;
extern template class Sha2<std::uint64_t>;

/// Whether `digest` is the SHA-256 of one piece.
bool is_sha256(std::span<const std::uint8_t, 32> digest, std::span<const std::uint8_t> message);
/// SHA-256 of one piece.
Sha256::Digest sha256(std::span<const std::uint8_t> message);

}  // namespace pharos::signature
