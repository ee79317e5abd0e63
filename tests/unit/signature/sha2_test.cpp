// SPDX-License-Identifier: Apache-2.0
// Vectors: examples of FIPS 180-4 (NIST, "SHA256.pdf", "SHA512.pdf"), and the empty message.
#include "pharos/signature/sha2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "unit/signature/hex.hpp"

namespace pharos::signature {
namespace {

using test::to_hex;

template <class Hash>
std::string hash_of(std::string_view text, std::size_t part = 1000000) {
  Hash hash;
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  for (std::size_t at = 0; at < bytes.size(); at += part)
    hash.add(bytes.subspan(at, std::min(part, bytes.size() - at)));
  return to_hex(hash.finish());
}

constexpr std::string_view kTwoBlocks = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
constexpr std::string_view kLongTwoBlocks =
    "abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu";

TEST(Sha256, OfThePublishedExamples) {
  EXPECT_EQ(hash_of<Sha256>(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of<Sha256>("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of<Sha256>(kTwoBlocks), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash_of<Sha256>(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha512, OfThePublishedExamples) {
  EXPECT_EQ(hash_of<Sha512>(""),
            "cf83e1357eefb8bdf1542850d66d8007d620e4050b5715dc83f4a921d36ce9ce"
            "47d0d13c5d85f2b0ff8318d2877eec2f63b931bd47417a81a538327af927da3e");
  EXPECT_EQ(hash_of<Sha512>("abc"),
            "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a"
            "2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e2a9ac94fa54ca49f");
  EXPECT_EQ(hash_of<Sha512>(kLongTwoBlocks),
            "8e959b75dae313da8cf4f72814fc143f8f7779c6eb9f7fa17299aeadb6889018"
            "501d289e4900f7e4331b99dec4b5433ac7d329eeb6dd26545e96e55b874be909");
}

TEST(Sha2, DoesNotDependOnTheParts) {
  for (std::size_t size = 0; size < 300; ++size) {
    const std::string text(size, 'x');
    for (const std::size_t part : {1u, 3u, 63u, 64u, 127u, 128u}) {
      ASSERT_EQ(hash_of<Sha256>(text, part), hash_of<Sha256>(text)) << size;
      ASSERT_EQ(hash_of<Sha512>(text, part), hash_of<Sha512>(text)) << size;
    }
  }
}

}  // namespace
}  // namespace pharos::signature
