// SPDX-License-Identifier: Apache-2.0
// MCAP files read back by a reader that was written from the specification (read_mcap.py), with every checksum, index
// and schema.
#include <gtest/gtest.h>

#include "exported.hpp"

namespace pharos::tools {
namespace {

test::ReadBack read_mcap(const test::TemporaryFolder& folder, const std::string& path) {
  return test::read_back(folder, std::string(PHAROS_PYTHON) + " -B " + PHAROS_READ_MCAP + " " + path);
}

TEST(Mcap, ReadBackIsEqualAndForeignMessagesAreCounted) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("log.mcap");
  const auto channels = test::export_log(folder, test::example_log(), path);
  test::expect_example(read_mcap(folder, path));
  const ChannelCounts& poses = channels.at("PHAROS_LIGHTHOUSE_POSE");
  EXPECT_EQ(poses.exported, 300);
  EXPECT_EQ(poses.foreign, 1);
  EXPECT_EQ(poses.not_finite, 1);
  EXPECT_EQ(poses.without_time, 1);
  EXPECT_EQ(channels.at("OTHER").foreign, 1);
}

// The examples of RFC 4648.
TEST(Mcap, PicturesAreBase64) {
  const auto text = [](const std::string& bytes) {
    return base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  };
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(text("f"), "Zg==");
  EXPECT_EQ(text("fo"), "Zm8=");
  EXPECT_EQ(text("foo"), "Zm9v");
  EXPECT_EQ(text("foobar"), "Zm9vYmFy");
}

TEST(Mcap, ManyCamerasShareATopicInTheEnd) {
  const test::TemporaryFolder folder;
  std::string log;
  for (int k = 0; k < 70; ++k) {
    log += test::logged(1000 + k, "P", test::encoded(test::some_preview("tof/" + std::to_string(k), "")));
  }
  const std::string path = folder.path("log.mcap");
  test::export_log(folder, log, path);
  const test::ReadBack read = read_mcap(folder, path);
  ASSERT_FALSE(read.failed) << read.text;
  EXPECT_EQ(test::of_topic(read, "/P/tof/63/image").size(), 1U);
  EXPECT_EQ(test::of_topic(read, "/P/image").size(), 6U);
}

TEST(Mcap, SeveralChunksAreIndexed) {
  const test::TemporaryFolder folder;
  std::string log;
  for (int k = 0; k < 1500; ++k) log += test::logged(test::kSomeTime_us - k, "A", test::encoded(test::some_pose(k)));
  const std::string path = folder.path("log.mcap");
  test::export_log(folder, log, path);
  EXPECT_GT(std::filesystem::file_size(path), 2 * McapWriter::kChunkBytes);
  const test::ReadBack read = read_mcap(folder, path);
  EXPECT_FALSE(read.failed) << read.text;
  EXPECT_EQ(read.messages.size(), 3U * 1500U);
}

TEST(Mcap, AFileWithoutMessagesIsWhole) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("log.mcap");
  test::export_log(folder, "", path);
  const test::ReadBack read = read_mcap(folder, path);
  EXPECT_FALSE(read.failed) << read.text;
  EXPECT_TRUE(read.messages.empty());
}

// The reader is one that notices: a changed bit anywhere is an error.
TEST(Mcap, TheReaderRefusesEveryChangedByte) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("log.mcap");
  test::export_log(folder, test::logged(1, "A", test::encoded(test::some_pose(1))), path);
  std::ifstream file(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t at = 3; at < whole.size(); at += whole.size() / 11) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_TRUE(read_mcap(folder, folder.write("changed.mcap", changed)).failed) << at;
  }
}

TEST(Mcap, ChannelsOfAnyNameAreTopics) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("log.mcap");
  test::export_log(folder, test::logged(1, "\xFF\n", test::encoded(test::some_pose(1))), path);
  const test::ReadBack read = read_mcap(folder, path);
  ASSERT_FALSE(read.failed) << read.text;
  EXPECT_EQ(read.messages[0]["topic"], "/??");
}

}  // namespace
}  // namespace pharos::tools
