// SPDX-License-Identifier: Apache-2.0
#include "tools/view/log_reader.hpp"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <random>

#include "host/support/input_error.hpp"
#include "some_messages.hpp"
#include "support/memory_file.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::tools {
namespace {

using test::MemoryFile;

const std::vector<unsigned char> kBytes = {1, 2, 3, 4, 5};

std::string three_events() {
  return test::log_event(0, 1'000'000, "A", kBytes) + test::log_event(1, 2'000'000, "B", {}) +
         test::log_event(2, 3'000'000, "C", kBytes);
}

std::string channels_of(const std::string& log, std::int64_t* skipped = nullptr) {
  const MemoryFile file(log.data(), log.size());
  LogReader reader(file.path());
  std::string channels;
  while (const auto message = reader.next()) channels += message->channel;
  if (skipped != nullptr) *skipped = reader.skipped();
  return channels;
}

TEST(LogReader, ReadsWhatLcmsOwnWriterWrote) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("poses.lcm");
  {
    lcm::LCM writer("file://" + file + "?mode=w");
    ASSERT_TRUE(writer.good());
    for (std::int64_t k = 0; k < 5; ++k) {
      const pose_t pose = test::some_pose(k);
      writer.publish("PHAROS_LIGHTHOUSE_POSE", &pose);
    }
  }
  LogReader reader(file);
  for (std::int64_t k = 0; k < 5; ++k) {
    const auto message = reader.next();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->channel, "PHAROS_LIGHTHOUSE_POSE");
    EXPECT_EQ(message->bytes, test::bytes_of(test::some_pose(k)));
    EXPECT_GT(message->utime_us, 1'500'000'000'000'000);
  }
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.skipped(), 0);
}

TEST(LogReader, AfterABrokenPieceTheNextMessageIsRead) {
  const std::string log = three_events();
  const std::size_t second = test::log_event(0, 0, "A", kBytes).size();
  std::int64_t skipped = 0;
  EXPECT_EQ(channels_of("garbage" + log, &skipped), "ABC");
  EXPECT_EQ(skipped, 1);
  std::string broken = log;
  broken[second + 20] = '\xff';  // the length of the second one's channel
  EXPECT_EQ(channels_of(broken, &skipped), "AC");
  EXPECT_GE(skipped, 1);
  broken = log;
  broken[second + 24] = '\x7f';  // the length of its message
  EXPECT_EQ(channels_of(broken, &skipped), "AC");
  broken = log;
  broken[second] = 0;  // its mark
  EXPECT_EQ(channels_of(broken, &skipped), "AC");
}

TEST(LogReader, ALogThatWasCutEndsBeforeTheCut) {
  const std::string log = three_events();
  for (std::size_t size = 0; size < log.size(); ++size) EXPECT_LT(channels_of(log.substr(0, size)).size(), 3u) << size;
}

TEST(LogReader, AnyBytesEnd) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::string log = three_events() + three_events();
    for (int k = 0; k < 8; ++k) log[random() % log.size()] = static_cast<char>(random());
    EXPECT_LE(channels_of(log).size(), 600u);
  }
}

TEST(LogReader, WhatIsNoFileIsRefused) {
  EXPECT_THROW(LogReader("/nonexistent/log"), host::InputError);
  EXPECT_THROW(LogReader("/tmp"), host::InputError);
}

}  // namespace
}  // namespace pharos::tools
