// SPDX-License-Identifier: Apache-2.0
// Vectors: RFC 8032, 7.1, tests 1, 2, 3 and SHA(abc).
#include "pharos/signature/ed25519.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "unit/signature/hex.hpp"

namespace pharos::signature {
namespace {

struct Vector {
  const char* key;
  const char* message;
  const char* signature;
};

constexpr Vector kVectors[] = {
    {"d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
     "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f0595bbe24"
     "655141438e7a100b"},
    {"3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "72",
     "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aee"
     "b00d291612bb0c00"},
    {"fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025", "af82",
     "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290ae67f760984dc6594a7c15e9716ed28d"
     "c027beceea1ec40a"},
    {"ec172b93ad5e563bf4932c70e1245034c35467ef2efd4d64ebf819683467e2bf",
     "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e"
     "2a9ac94fa54ca49f",
     "dc2a4459e7369633a52b1bf277839a00201009a3efbf3ecb69bea2186c26b58909351fc9ac90b3ecfdfbc7c66431e0303dca179c138ac17a"
     "d9bef1177331a704"},
};

template <std::size_t N>
std::array<std::uint8_t, N> array_of(const char* text) {
  std::array<std::uint8_t, N> result{};
  std::ranges::copy(test::from_hex(text), result.begin());
  return result;
}

struct Signed {
  explicit Signed(const Vector& from)
      : key(array_of<32>(from.key)), message(test::from_hex(from.message)), signature(array_of<64>(from.signature)) {}
  bool is_good() const { return verify(signature, key, message); }

  PublicKey key;
  std::vector<std::uint8_t> message;
  Signature signature;
};

TEST(Ed25519, AcceptsThePublishedSignatures) {
  for (const Vector& vector : kVectors) EXPECT_TRUE(Signed(vector).is_good()) << vector.key;
}

TEST(Ed25519, RefusesASignatureWithAnyBitFlipped) {
  for (std::size_t bit = 0; bit < 512; ++bit) {
    Signed changed(kVectors[2]);
    changed.signature[bit / 8] ^= static_cast<std::uint8_t>(1 << (bit % 8));
    ASSERT_FALSE(changed.is_good()) << bit;
  }
}

TEST(Ed25519, RefusesAMessageOrKeyWithAnyBitFlipped) {
  for (std::size_t bit = 0; bit < 512; ++bit) {
    Signed changed(kVectors[3]);
    changed.message[bit / 8] ^= static_cast<std::uint8_t>(1 << (bit % 8));
    ASSERT_FALSE(changed.is_good()) << bit;
    Signed other(kVectors[3]);
    other.key[bit / 8 % 32] ^= static_cast<std::uint8_t>(1 << (bit % 8));
    ASSERT_FALSE(other.is_good()) << bit;
  }
}

TEST(Ed25519, RefusesAnotherMessageOrKey) {
  Signed longer(kVectors[1]);
  longer.message.push_back(0);
  EXPECT_FALSE(longer.is_good());
  Signed other(kVectors[1]);
  other.key = Signed(kVectors[2]).key;
  EXPECT_FALSE(other.is_good());
}

TEST(Ed25519, RefusesTheSecondFormOfASignature) {
  // S + L satisfies the equation too; RFC 8032 allows S below L only.
  const auto order = array_of<32>("edd3f55c1a631258d69cf7a2def9de1400000000000000000000000000000010");
  Signed changed(kVectors[0]);
  unsigned carry = 0;
  for (std::size_t i = 0; i < 32; ++i) {
    carry += static_cast<unsigned>(changed.signature[32 + i]) + order[i];
    changed.signature[32 + i] = static_cast<std::uint8_t>(carry);
    carry >>= 8;
  }
  EXPECT_FALSE(changed.is_good());
}

TEST(Ed25519, RefusesAKeyThatIsNoPointOrNotInItsOnlyForm) {
  Signed changed(kVectors[0]);
  changed.key = array_of<32>("0200000000000000000000000000000000000000000000000000000000000000");  // not on the curve
  EXPECT_FALSE(changed.is_good());
  // With the neutral point as its key, R = S B is a signature of everything: accepted here, as the equation says; a key
  // is chosen by whoever builds. Its other encodings are refused.
  Signed neutral(kVectors[0]);
  neutral.key = array_of<32>("0100000000000000000000000000000000000000000000000000000000000000");
  neutral.signature = {};
  neutral.signature[0] = 1;
  EXPECT_TRUE(neutral.is_good());
  neutral.key = array_of<32>("0100000000000000000000000000000000000000000000000000000000000080");  // x = 0, signed
  EXPECT_FALSE(neutral.is_good());
  neutral.key = array_of<32>("eeffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff7f");  // y = p + 1
  EXPECT_FALSE(neutral.is_good());
}

}  // namespace
}  // namespace pharos::signature
