// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/cobs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "pharos/wire/frame.hpp"

namespace pharos::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes stuff(const Bytes& plain) {
  Bytes out(stuffed_size(plain.size()));
  CobsWriter writer(out);
  writer.put(plain);
  out.resize(writer.finish());
  return out;
}

std::optional<Bytes> unstuff(Bytes stuffed) {
  const auto size = cobs_decode_in_place(stuffed);
  if (!size) return std::nullopt;
  stuffed.resize(*size);
  return stuffed;
}

Bytes counting(std::size_t first, std::size_t count) {
  Bytes out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(static_cast<std::uint8_t>(first + i));
  return out;
}

TEST(Cobs, StuffsThePublishedExamples) {
  EXPECT_EQ(stuff({}), (Bytes{1}));
  EXPECT_EQ(stuff({0}), (Bytes{1, 1}));
  EXPECT_EQ(stuff({0, 0}), (Bytes{1, 1, 1}));
  EXPECT_EQ(stuff({0x11, 0x22, 0x00, 0x33}), (Bytes{3, 0x11, 0x22, 2, 0x33}));
  EXPECT_EQ(stuff({0x11, 0, 0, 0}), (Bytes{2, 0x11, 1, 1, 1}));
}

TEST(Cobs, ClosesAFullBlockOnlyWhenSomethingFollows) {
  Bytes expected = counting(1, 254);
  expected.insert(expected.begin(), 0xFF);
  EXPECT_EQ(stuff(counting(1, 254)), expected);
  Bytes longer = counting(1, 254);
  longer.push_back(0);
  expected.push_back(1);
  expected.push_back(1);
  EXPECT_EQ(stuff(longer), expected);
}

TEST(Cobs, RoundTripsEveryLengthAndHoldsNoZero) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size <= kMaxFrame; ++size) {
    for (const int zeros_of_16 : {0, 1, 15}) {
      Bytes plain(size);
      for (auto& byte : plain) {
        byte = static_cast<int>(random() % 16) < zeros_of_16 ? std::uint8_t{0}
                                                             : static_cast<std::uint8_t>(1 + random() % 255);
      }
      const Bytes stuffed = stuff(plain);
      ASSERT_LE(stuffed.size(), stuffed_size(size));
      ASSERT_EQ(std::count(stuffed.begin(), stuffed.end(), 0), 0);
      ASSERT_EQ(unstuff(stuffed), plain);
    }
  }
}

TEST(Cobs, WorstCaseIsReached) { EXPECT_EQ(stuff(Bytes(509, 7)).size(), stuffed_size(509)); }

TEST(Cobs, RefusesAZeroWithinAndABlockThatRunsPastTheEnd) {
  EXPECT_EQ(unstuff({3, 0x11, 0}), std::nullopt);
  EXPECT_EQ(unstuff({0}), std::nullopt);
  EXPECT_EQ(unstuff({4, 0x11, 0x22}), std::nullopt);
  EXPECT_EQ(unstuff({2, 0x11, 0xFF}), std::nullopt);
}

TEST(Cobs, NeverWritesPastTheEnd) {
  const Bytes plain = counting(0, 300);
  const std::size_t whole = stuff(plain).size();
  for (std::size_t room = 0; room < whole; ++room) {
    Bytes out(room + 4, 0xA5);
    CobsWriter writer{std::span(out).first(room)};
    writer.put(plain);
    EXPECT_EQ(writer.finish(), 0u);
    EXPECT_EQ(Bytes(out.end() - 4, out.end()), Bytes(4, 0xA5));
  }
}

}  // namespace
}  // namespace pharos::wire
