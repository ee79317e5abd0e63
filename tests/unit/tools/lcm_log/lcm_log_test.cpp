// SPDX-License-Identifier: Apache-2.0
#include "tools/lcm_log/lcm_log.hpp"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <vector>

#include "host/support/input_error.hpp"
#include "tests/support/gzipped.hpp"
#include "tests/support/lcm_log.hpp"
#include "tests/support/temporary_folder.hpp"

namespace pharos::tools {
namespace {

using test::logged;

struct Read {
  std::vector<std::string> channels, data;
  std::vector<std::int64_t> times_us;
  LcmLogCounters counters;
};

Read read(const std::string& path) {
  LcmLogReader reader{host::ByteSource(path)};
  Read out;
  while (const auto message = reader.next()) {
    out.channels.emplace_back(message->channel);
    out.data.emplace_back(message->data);
    out.times_us.push_back(message->utime_us);
  }
  out.counters = reader.counters();
  return out;
}
Read read_bytes(const std::string& bytes) {
  const test::TemporaryFolder folder;
  return read(folder.write("log", bytes));
}

TEST(LcmLog, ReadsWhatLcmWrites) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("log");
  std::vector<std::string> data;
  {
    lcm::LogFile log(path, "w");
    for (int k = 0; k < 50; ++k) {
      data.emplace_back(static_cast<std::size_t>(k * k * 20), static_cast<char>(k));
      lcm::LogEvent event{k, 1000 + k, "CHANNEL_" + std::to_string(k),
                          static_cast<int>(data[static_cast<std::size_t>(k)].size()),
                          data[static_cast<std::size_t>(k)].data()};
      ASSERT_EQ(log.writeEvent(&event), 0);
    }
  }
  const Read log = read(path);
  EXPECT_EQ(log.data, data);
  EXPECT_EQ(log.channels.back(), "CHANNEL_49");
  EXPECT_EQ(log.times_us.back(), 1049);
  EXPECT_EQ(log.counters.damaged, 0);
  EXPECT_FALSE(log.counters.cut_off);
}

TEST(LcmLog, SkipsDamageAndGoesOnBehindIt) {
  const std::string one = logged(1, "A", "first"), two = logged(2, "B", "second"), three = logged(3, "C", "third");
  EXPECT_EQ(read_bytes("rubbish" + one + two).channels, (std::vector<std::string>{"A", "B"}));
  const Read between = read_bytes(one + "rubbish" + two + three);
  EXPECT_EQ(between.channels, (std::vector<std::string>{"B", "C"})) << "what is followed by no message is not whole";
  EXPECT_EQ(between.counters.damaged, 1);
  EXPECT_EQ(between.counters.bytes_skipped, static_cast<std::int64_t>(one.size() + 7));
  std::string wrong_length = two;
  wrong_length[27] = 100;  // of the data: swallows what follows
  EXPECT_EQ(read_bytes(one + wrong_length + three).channels, (std::vector<std::string>{"A", "C"}));
  wrong_length[24] = 127;  // gigabytes
  EXPECT_EQ(read_bytes(one + wrong_length + three).channels, (std::vector<std::string>{"A", "C"}));
}

TEST(LcmLog, EveryCutKeepsTheMessagesBeforeIt) {
  const std::string one = logged(1, "A", "first"), two = logged(2, "B", "second");
  for (std::size_t cut = 1; cut < two.size(); ++cut) {
    const Read log = read_bytes(one + two.substr(0, cut));
    EXPECT_EQ(log.channels, std::vector<std::string>{"A"}) << cut;
    EXPECT_TRUE(log.counters.cut_off || cut < 4) << cut;
  }
}

TEST(LcmLog, TheWordWithinAMessageDoesNotEndIt) {
  const std::string inner = logged(1, "INNER", "x");
  const Read log = read_bytes(logged(2, "A", inner) + logged(3, "B", ""));
  EXPECT_EQ(log.channels, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(log.data[0], inner);
}

TEST(LcmLog, AnEmptyFileHasNoMessage) {
  EXPECT_TRUE(read_bytes("").channels.empty());
  const Read rubbish = read_bytes(std::string(100'000, '\xED'));
  EXPECT_TRUE(rubbish.channels.empty());
  EXPECT_EQ(rubbish.counters.bytes_skipped, 100'000);
}

// A log read from each place again: the same messages from there on.
void expect_every_place_again(const std::string& path) {
  LcmLogReader reader{host::ByteSource(path)};
  const std::vector<std::string> all = read(path).channels;
  for (std::size_t next = 0; next <= all.size(); ++next) {
    LcmLogReader again(host::ByteSource(path), reader.position());
    for (std::size_t k = next; k < all.size(); ++k) {
      const auto message = again.next();
      ASSERT_TRUE(message) << next;
      EXPECT_EQ(message->channel, all[k]) << next;
    }
    EXPECT_FALSE(again.next());
    reader.next();
  }
}

TEST(LcmLog, GoesOnFromAnyPlaceOfAPlainAndOfAPackedLog) {
  const test::TemporaryFolder folder;
  std::string log;
  for (int k = 0; k < 6; ++k) log += logged(k, "CHANNEL_" + std::to_string(k), std::string(60'000, 'x')) + "rubbish";
  expect_every_place_again(folder.write("log", log));
  expect_every_place_again(folder.write("log.gz", test::gzipped(log)));
  EXPECT_FALSE(LcmLogReader(host::ByteSource(folder.path("log")), 1'000'000'000).next()) << "behind its end";
}

TEST(LcmLog, WhatIsNoFileIsRefused) {
  EXPECT_THROW(read("/nonexistent/log"), host::InputError);
  EXPECT_THROW(read("/tmp"), host::InputError);
}

}  // namespace
}  // namespace pharos::tools
