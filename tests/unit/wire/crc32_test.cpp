// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/crc32.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace pharos::wire {
namespace {

std::vector<std::uint8_t> bytes(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Crc32, GivesThePublishedCheckValues) {
  EXPECT_EQ(crc32({}), 0u);
  EXPECT_EQ(crc32(bytes("123456789")), 0xCBF43926u);
  EXPECT_EQ(crc32(bytes("The quick brown fox jumps over the lazy dog")), 0x414FA339u);
  EXPECT_EQ(crc32(std::vector<std::uint8_t>(32, 0)), 0x190A55ADu);
  EXPECT_EQ(crc32(std::vector<std::uint8_t>(32, 0xFF)), 0xFF6CAB0Bu);
}

TEST(Crc32, GoesOnWhereItStopped) { EXPECT_EQ(crc32(bytes("6789"), crc32(bytes("12345"))), 0xCBF43926u); }

}  // namespace
}  // namespace pharos::wire
