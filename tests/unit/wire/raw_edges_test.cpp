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
    const auto payload = packer.payload(17);
    const auto message = decode_payload<RawEdges>(payload);
    ASSERT_TRUE(message.ok());
    EXPECT_EQ(message->edges_lost, 17u);
    test::Bytes again(kMaxPayload);
    again.resize(encode_payload(*message, again));
    EXPECT_TRUE(std::equal(payload.begin(), payload.end(), again.begin(), again.end()));
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

TEST(RawEdgesPacker, GivesAnEmptyMessageWhenNothingWasPushed) {
  RawEdgesPacker packer;
  packer.push({5, 1, true});
  packer.clear();
  const auto message = decode_payload<RawEdges>(packer.payload(3));
  ASSERT_TRUE(message.ok());
  EXPECT_TRUE(message->edges.empty());
}

TEST(RawEdgesPacker, LeavesOutWhatCannotBeSent) {
  RawEdgesPacker packer;
  EXPECT_TRUE(packer.push({5, 32, true}));
  EXPECT_TRUE(packer.push({kMaxTicks + 1, 3, true}));
  EXPECT_TRUE(packer.empty());
}

TEST(RawEdgesPacker, HoldsAtLeastFortyFiveEdgesWithAnyStamps) {
  RawEdgesPacker packer;
  std::size_t count = 0;
  for (std::int64_t sign = 1; packer.push({sign * kMaxTicks, 31, true}); sign = -sign) ++count;
  EXPECT_GE(count, 45u);
}

}  // namespace
}  // namespace pharos::wire
