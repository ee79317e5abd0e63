// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "pharos/wire/raw_edges_message.hpp"
#include "unit/wire/random_messages.hpp"

namespace pharos::wire {
namespace {

TEST(RawEdgesPacker, LosesNoEdgeOfALongStream) {
  test::RandomMessages random(21);
  std::vector<RawEdge> sent;
  std::vector<RawEdge> received;
  RawEdgesPacker packer;
  const auto deliver = [&] {
    std::array<std::uint8_t, RawEdges::kMaxBytes> payload{};
    const std::size_t size = encode_payload(packer.message(), payload);
    ASSERT_GT(size, 0u) << "a packed message must always fit";
    const auto message = decode_payload<RawEdges>(std::span(payload).first(size));
    ASSERT_TRUE(message.ok());
    received.insert(received.end(), message->edges.begin(), message->edges.end());
    packer.clear();
  };
  for (int i = 0; i < 50000; ++i) {
    const std::int64_t stamp = random.below(50) == 0 ? random.ticks() : static_cast<std::int64_t>(i) * 5000;
    const RawEdge edge{stamp, static_cast<std::uint8_t>(random.below(32)), random.below(2) == 0};
    sent.push_back(edge);
    if (packer.push(edge)) continue;
    deliver();
    ASSERT_TRUE(packer.push(edge));
  }
  deliver();
  EXPECT_EQ(received, sent);
}

TEST(RawEdgesPacker, HoldsAtLeastFortyFiveEdgesWithAnyStamps) {
  RawEdgesPacker packer;
  std::size_t count = 0;
  for (std::int64_t sign = 1; packer.push({sign * kMaxTicks, 31, true}); sign = -sign) ++count;
  EXPECT_GE(count, 45u);
}

}  // namespace
}  // namespace pharos::wire
