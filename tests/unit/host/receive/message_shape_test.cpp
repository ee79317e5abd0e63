// SPDX-License-Identifier: Apache-2.0
#include "host/receive/message_shape.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "pharos/bearings_t.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"

namespace pharos::host {
namespace {

template <class Message>
Message example() {
  Message message{};
  message.source = "lighthouse/chaser";
  message.target = "dock";
  return message;
}
template <>
bearings_t example<bearings_t>() {
  bearings_t message{};
  message.source = "lighthouse/chaser";
  message.bearings.resize(3);
  message.count = 3;
  return message;
}
template <>
clock_exchange_t example<clock_exchange_t>() {
  clock_exchange_t message{};
  message.sender = "chaser";
  message.recipient = "cameras";
  message.received_ns = 1;
  return message;
}
template <>
preview_t example<preview_t>() {
  preview_t message{};
  message.source = "tof/helios";
  message.format = "jpeg";
  message.data = {0xFF, 0xD8, 1, 2, 3, 0xFF, 0xD9};
  message.size = 7;
  return message;
}
template <>
target_state_t example<target_state_t>() {
  target_state_t message{};
  message.target = "dock";
  message.mode = "fused";
  message.sources.resize(2);
  message.sources[1].reason = "step";
  message.source_count = 2;
  return message;
}
template <>
status_t example<status_t>() {
  status_t message{};
  message.host = "chaser";
  message.counters = {{"poses", 7}, {"bytes", 9}};
  message.counter_count = 2;
  source_status_t source{};
  source.message = "no frames";
  source.counters = {{"frames", 1}};
  source.counter_count = 1;
  message.sources = {source, source};
  message.source_count = 2;
  return message;
}

template <class Message>
class Shape : public ::testing::Test {
 protected:
  static std::vector<unsigned char> encoded() {
    const Message message = example<Message>();
    std::vector<unsigned char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  }
  static bool is_message(const std::vector<unsigned char>& bytes) {
    Message message;
    return decode(message, bytes.data(), static_cast<int>(bytes.size()));
  }
};
using Types =
    ::testing::Types<pose_t, pointing_t, spin_t, bearings_t, status_t, target_state_t, clock_exchange_t, preview_t>;
TYPED_TEST_SUITE(Shape, Types);

TYPED_TEST(Shape, IsThatOfTheType) { EXPECT_TRUE(this->is_message(this->encoded())); }

TYPED_TEST(Shape, NoPartOfAMessageIsOne) {
  std::vector<unsigned char> bytes = this->encoded();
  bytes.push_back(0);
  EXPECT_FALSE(this->is_message(bytes)) << "one byte more";
  bytes.pop_back();
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_FALSE(this->is_message(bytes)) << bytes.size();
  }
}

// Wherever the four bytes lie, on a length or elsewhere: an answer, and neither an exception nor all memory.
TYPED_TEST(Shape, ALengthThatLiesIsRefused) {
  const std::vector<unsigned char> good = this->encoded();
  for (std::size_t at = 8; at + 4 <= good.size(); ++at) {
    for (const unsigned char first : std::vector<unsigned char>{0x00, 0x7F, 0x80, 0xFF}) {
      std::vector<unsigned char> bytes = good;
      for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = first;
      EXPECT_NO_THROW(this->is_message(bytes)) << at;
    }
  }
}

// A list of single bytes is skipped as a whole: its count must fit what is left.
TEST(PreviewShape, ASizeThatLiesIsRefused) {
  const preview_t message = example<preview_t>();
  std::vector<unsigned char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  const std::size_t at = bytes.size() - message.data.size() - 4;
  preview_t read;
  for (const std::uint32_t size : {0U, 6U, 8U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU}) {
    for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<unsigned char>(size >> (24U - 8U * k));
    EXPECT_FALSE(decode(read, bytes.data(), static_cast<int>(bytes.size()))) << size;
  }
  bytes[at] = bytes[at + 1] = bytes[at + 2] = 0;
  bytes[at + 3] = 7;
  EXPECT_TRUE(decode(read, bytes.data(), static_cast<int>(bytes.size())));
}

}  // namespace
}  // namespace pharos::host
