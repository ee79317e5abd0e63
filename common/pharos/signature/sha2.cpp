// SPDX-License-Identifier: Apache-2.0
#include "pharos/signature/sha2.hpp"

#include <bit>
#include <cstring>

namespace pharos::signature {
namespace {

/// Fractions of the square roots of the first 8 primes, and of the cube roots of the first 80.
constexpr std::array<std::uint64_t, 8> kStart = {
    0x6a09e667f3bcc908, 0xbb67ae8584caa73b, 0x3c6ef372fe94f82b, 0xa54ff53a5f1d36f1,
    0x510e527fade682d1, 0x9b05688c2b3e6c1f, 0x1f83d9abfb41bd6b, 0x5be0cd19137e2179,
};
constexpr std::array<std::uint64_t, 80> kRound = {
    0x428a2f98d728ae22, 0x7137449123ef65cd, 0xb5c0fbcfec4d3b2f, 0xe9b5dba58189dbbc, 0x3956c25bf348b538,
    0x59f111f1b605d019, 0x923f82a4af194f9b, 0xab1c5ed5da6d8118, 0xd807aa98a3030242, 0x12835b0145706fbe,
    0x243185be4ee4b28c, 0x550c7dc3d5ffb4e2, 0x72be5d74f27b896f, 0x80deb1fe3b1696b1, 0x9bdc06a725c71235,
    0xc19bf174cf692694, 0xe49b69c19ef14ad2, 0xefbe4786384f25e3, 0x0fc19dc68b8cd5b5, 0x240ca1cc77ac9c65,
    0x2de92c6f592b0275, 0x4a7484aa6ea6e483, 0x5cb0a9dcbd41fbd4, 0x76f988da831153b5, 0x983e5152ee66dfab,
    0xa831c66d2db43210, 0xb00327c898fb213f, 0xbf597fc7beef0ee4, 0xc6e00bf33da88fc2, 0xd5a79147930aa725,
    0x06ca6351e003826f, 0x142929670a0e6e70, 0x27b70a8546d22ffc, 0x2e1b21385c26c926, 0x4d2c6dfc5ac42aed,
    0x53380d139d95b3df, 0x650a73548baf63de, 0x766a0abb3c77b2a8, 0x81c2c92e47edaee6, 0x92722c851482353b,
    0xa2bfe8a14cf10364, 0xa81a664bbc423001, 0xc24b8b70d0f89791, 0xc76c51a30654be30, 0xd192e819d6ef5218,
    0xd69906245565a910, 0xf40e35855771202a, 0x106aa07032bbd1b8, 0x19a4c116b8d2d0c8, 0x1e376c085141ab53,
    0x2748774cdf8eeb99, 0x34b0bcb5e19b48a8, 0x391c0cb3c5c95a63, 0x4ed8aa4ae3418acb, 0x5b9cca4f7763e373,
    0x682e6ff3d6b2b8a3, 0x748f82ee5defb2fc, 0x78a5636f43172f60, 0x84c87814a1f0ab72, 0x8cc702081a6439ec,
    0x90befffa23631e28, 0xa4506cebde82bde9, 0xbef9a3f7b2c67915, 0xc67178f2e372532b, 0xca273eceea26619c,
    0xd186b8c721c0c207, 0xeada7dd6cde0eb1e, 0xf57d4f7fee6ed178, 0x06f067aa72176fba, 0x0a637dc5a2c898a6,
    0x113f9804bef90dae, 0x1b710b35131c471b, 0x28db77f523047d84, 0x32caab7b40c72493, 0x3c9ebe0a15c9bebc,
    0x431d67c49c100d4c, 0x4cc5d4becb3e42b6, 0x597f299cfc657e2a, 0x5fcb6fab3ad6faec, 0x6c44198c4a475817,
};

/// The upper bits of the first of them: SHA-256's own table at compile time, since it lies in a ROM without the other.
template <class Word, std::size_t N, std::size_t M>
constexpr std::array<Word, N> upper(const std::array<std::uint64_t, M>& table) {
  std::array<Word, N> result{};
  for (std::size_t i = 0; i < N; ++i) result[i] = static_cast<Word>(table[i] >> (64 - 8 * sizeof(Word)));
  return result;
}
template <class Word>
constexpr std::array<Word, 8> kStartOf = upper<Word, 8>(kStart);
template <class Word>
constexpr std::array<Word, (sizeof(Word) == 4 ? 64 : 80)> kRoundOf = upper<Word, (sizeof(Word) == 4 ? 64 : 80)>(kRound);

/// Rotations and shifts of FIPS 180-4, 4.1.2 and 4.1.3.
template <class Word>
struct Amounts;
template <>
struct Amounts<std::uint32_t> {
  static constexpr std::array<int, 3> kSum0 = {2, 13, 22}, kSum1 = {6, 11, 25}, kSigma0 = {7, 18, 3},
                                      kSigma1 = {17, 19, 10};
};
template <>
struct Amounts<std::uint64_t> {
  static constexpr std::array<int, 3> kSum0 = {28, 34, 39}, kSum1 = {14, 18, 41}, kSigma0 = {1, 8, 7},
                                      kSigma1 = {19, 61, 6};
};

template <class Word>
Word sum(Word x, const std::array<int, 3>& by) {
  return std::rotr(x, by[0]) ^ std::rotr(x, by[1]) ^ std::rotr(x, by[2]);
}
template <class Word>
Word sigma(Word x, const std::array<int, 3>& by) {
  return std::rotr(x, by[0]) ^ std::rotr(x, by[1]) ^ (x >> by[2]);
}

}  // namespace

template <class Word>
Sha2<Word>::Sha2() : state_(kStartOf<Word>) {}

template <class Word>
void Sha2<Word>::compress() {
  using A = Amounts<Word>;
  std::array<Word, 8> s = state_;  // a to h
  for (std::size_t round = 0; round < kRoundOf<Word>.size(); ++round) {
    Word& word = block_[round % 16];
    if (round >= 16) {
      word += sigma(block_[(round + 14) % 16], A::kSigma1) + block_[(round + 9) % 16] +
              sigma(block_[(round + 1) % 16], A::kSigma0);
    }
    const Word choice = (s[4] & s[5]) ^ (~s[4] & s[6]);
    const Word majority = (s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]);
    const Word first = s[7] + sum(s[4], A::kSum1) + choice + kRoundOf<Word>[round] + word;
    const Word second = sum(s[0], A::kSum0) + majority;
    for (std::size_t i = 7; i > 0; --i) s[i] = s[i - 1];
    s[4] += first;
    s[0] = first + second;
  }
  for (std::size_t i = 0; i < 8; ++i) state_[i] += s[i];
}

template <class Word>
void Sha2<Word>::put(std::uint8_t byte) {
  Word& word = block_[bytes_ % kBlockBytes / sizeof(Word)];
  word = static_cast<Word>((word << 8) | byte);
  ++bytes_;
  if (bytes_ % kBlockBytes == 0) compress();
}

template <class Word>
void Sha2<Word>::add(std::span<const std::uint8_t> part) {
  for (const std::uint8_t byte : part) put(byte);
}

template <class Word>
auto Sha2<Word>::finish() -> Digest {
  const std::uint32_t bits = 8 * bytes_;
  put(0x80);
  // The length has two words, of which the last four bytes are not 0 here.
  while (bytes_ % kBlockBytes != kBlockBytes - 2 * sizeof(Word)) put(0);
  for (std::size_t i = 4; i < 2 * sizeof(Word); ++i) put(0);
  for (int shift = 24; shift >= 0; shift -= 8) put(static_cast<std::uint8_t>(bits >> shift));
  Digest digest;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const std::size_t shift = 8 * (sizeof(Word) - 1 - i % sizeof(Word));
    digest[i] = static_cast<std::uint8_t>(state_[i / sizeof(Word)] >> shift);
  }
  return digest;
}

template class Sha2<std::uint32_t>;
template class Sha2<std::uint64_t>;

Sha256::Digest sha256(std::span<const std::uint8_t> message) {
  Sha256 hash;
  hash.add(message);
  return hash.finish();
}

bool is_sha256(std::span<const std::uint8_t, 32> digest, std::span<const std::uint8_t> message) {
  Sha256 hash;
  hash.add(message);
  const Sha256::Digest found = hash.finish();
  return std::memcmp(found.data(), digest.data(), found.size()) == 0;
}

}  // namespace pharos::signature
