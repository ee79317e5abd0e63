// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/message_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "logged.hpp"
#include "tools/listen/subscription.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kFingerprint = 8;

template <class Message>
bool decodes(const std::string& bytes) {
  Message message;
  return decode(message, bytes.data(), static_cast<int>(bytes.size()));
}

// The layouts are those of the types: every message fits to the last byte, and no shorter or longer one does.
template <class Message>
void expect_layout(const Message& message) {
  const std::string whole = test::encoded(message);
  EXPECT_TRUE(decodes<Message>(whole)) << Message::getTypeName();
  EXPECT_FALSE(decodes<Message>(whole + '\0')) << Message::getTypeName();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(decodes<Message>(whole.substr(0, size))) << Message::getTypeName() << ' ' << size;
  }
}

TEST(MessageCheck, WholeMessagesOfEveryTypeFit) {
  expect_layout(test::some_pose(1));
  expect_layout(test::some_status());
  expect_layout(test::some_bearings());
  expect_layout(pointing_t{});
  expect_layout(spin_t{});
}

// Without the check the decoder throws, or takes all memory.
TEST(MessageCheck, WrongLengthsAreRefused) {
  for (const std::string& length :
       {test::big_endian(0, 4), test::big_endian(0xFFFFFFFFU, 4), test::big_endian(0x7FFFFFFFU, 4)}) {
    std::string pose = test::encoded(test::some_pose(1));
    pose.replace(kFingerprint + 24, 4, length);  // of `source`
    EXPECT_FALSE(decodes<pose_t>(pose));
    std::string bearings = test::encoded(test::some_bearings());
    const std::size_t count_at = bearings.size() - 3 * 35 - 4;
    bearings.replace(count_at, 4, length);
    EXPECT_FALSE(decodes<bearings_t>(bearings));
  }
}

TEST(MessageCheck, ChangedBytesNeitherThrowNorTakeMemory) {
  std::mt19937 random(5);
  for (const std::string& whole :
       {test::encoded(test::some_pose(1)), test::encoded(test::some_status()), test::encoded(test::some_bearings())}) {
    for (int k = 0; k < 20'000; ++k) {
      std::string bytes = whole;
      bytes[kFingerprint + random() % (bytes.size() - kFingerprint)] = static_cast<char>(random());
      EXPECT_NO_THROW({
        decodes<pose_t>(bytes);
        decodes<status_t>(bytes);
        decodes<bearings_t>(bytes);
      });
    }
  }
}

}  // namespace
}  // namespace pharos::tools
