// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "pharos/base/result.hpp"
#include "pharos/base/ring_buffer.hpp"
#include "pharos/base/static_vector.hpp"

namespace pharos {
namespace {

TEST(StaticVector, RefusesWhenFullAndKeepsWhatItHas) {
  StaticVector<int, 2> v;
  EXPECT_TRUE(v.push_back(1));
  EXPECT_TRUE(v.push_back(2));
  EXPECT_FALSE(v.push_back(3));
  ASSERT_EQ(v.size(), 2u);
  EXPECT_EQ(v[0], 1);
  EXPECT_EQ(v[1], 2);
}

TEST(StaticVector, ErasesUnordered) {
  StaticVector<int, 4> v;
  for (int i = 0; i < 4; ++i) v.push_back(i);
  v.erase_unordered(1);
  ASSERT_EQ(v.size(), 3u);
  EXPECT_EQ(v[1], 3);
  v.erase_unordered(2);
  EXPECT_EQ(v.size(), 2u);
}

TEST(RingBuffer, KeepsOrderThroughManyWraps) {
  RingBuffer<int, 3> ring;
  int in = 0;
  int out = 0;
  for (int round = 0; round < 50; ++round) {
    while (ring.push(in)) ++in;
    EXPECT_TRUE(ring.full());
    EXPECT_EQ(ring[2], in - 1);
    EXPECT_EQ(ring.pop(), out++);
    EXPECT_EQ(ring.pop(), out++);
  }
  EXPECT_EQ(ring.size(), 1u);
}

enum class Why { kNone, kBecause };

TEST(Result, CarriesAValueOrAReason) {
  const Result<int, Why> good(3);
  const Result<int, Why> bad(Why::kBecause);
  EXPECT_TRUE(good.ok());
  EXPECT_EQ(*good, 3);
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error(), Why::kBecause);
}

}  // namespace
}  // namespace pharos
