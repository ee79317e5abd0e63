// SPDX-License-Identifier: Apache-2.0
#include "host/table/byte_source.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "tests/support/error_of.hpp"
#include "tests/support/gzipped.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using pharos::test::error_of;
using pharos::test::gzipped;
using pharos::test::TemporaryFile;

std::string all_of(ByteSource& source) {
  std::string text;
  std::array<char, 7> piece;
  while (const std::size_t got = source.read(piece)) text.append(piece.data(), got);
  return text;
}

std::string long_text() {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i * 7919) + ",";
  return text;
}

TEST(ByteSource, GivesAPlainFileAsItIs) {
  const TemporaryFile file(long_text());
  ByteSource source(file.path());
  EXPECT_EQ(all_of(source), long_text());
  EXPECT_FALSE(source.cut_off());
}

TEST(ByteSource, LeavesBytesOutOfPlainAndPackedFiles) {
  const std::string text = long_text();
  const TemporaryFile plain(text), packed(gzipped(text));
  for (const std::string& path : {plain.path(), packed.path()}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{131'072}, std::size_t{400'001}}) {
      ByteSource source(path);
      std::array<char, 7> piece;
      const std::size_t before = source.read(piece);
      EXPECT_EQ(source.skip(static_cast<std::int64_t>(count)), static_cast<std::int64_t>(count));
      EXPECT_EQ(all_of(source), text.substr(before + count)) << count;
    }
    ByteSource source(path);
    source.skip(1LL << 40);
    EXPECT_EQ(all_of(source), "") << "behind the end";
  }
}

TEST(ByteSource, SaysBeforeItWaitsForAPipeThatPauses) {
  const std::string path = ::testing::TempDir() + "pharos_pausing_pipe_" + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int writer = ::open(path.c_str(), O_RDWR);  // both ends, so that neither open waits
  ASSERT_GE(writer, 0);
  ASSERT_EQ(::write(writer, "ab", 2), 2);
  ByteSource source(path);
  int pauses = 0;
  source.on_pause([&] {
    ++pauses;
    ASSERT_EQ(::write(writer, "cd", 2), 2);  // the pause ends
  });
  std::array<char, 7> piece;
  EXPECT_EQ(source.read(piece), 2u);
  EXPECT_EQ(pauses, 0);
  EXPECT_EQ(source.read(piece), 2u);
  EXPECT_EQ(pauses, 1);
  ::close(writer);
  std::remove(path.c_str());
}

TEST(ByteSource, UnpacksGzipWhateverTheFilesName) {
  const TemporaryFile file(gzipped(long_text()));
  ByteSource source(file.path());
  EXPECT_EQ(all_of(source), long_text());
  EXPECT_FALSE(source.cut_off());
}

TEST(ByteSource, JoinsGzipMembersInOneFile) {
  const TemporaryFile file(gzipped("first,") + gzipped("second"));
  ByteSource source(file.path());
  EXPECT_EQ(all_of(source), "first,second");
}

TEST(ByteSource, GivesWhatACutOffGzipFileHoldsAndSaysSo) {
  const std::string whole = gzipped(long_text());
  const TemporaryFile file(std::string_view(whole).substr(0, whole.size() / 2));
  ByteSource source(file.path());
  const std::string text = all_of(source);
  EXPECT_GT(text.size(), long_text().size() / 4);
  EXPECT_TRUE(long_text().starts_with(text));
  EXPECT_TRUE(source.cut_off());
}

TEST(ByteSource, RefusesBrokenGzipData) {
  std::string broken = gzipped(long_text());
  for (std::size_t i = broken.size() / 2; i < broken.size() / 2 + 64; ++i) broken[i] = '\x55';
  const TemporaryFile file(broken);
  ByteSource source(file.path());
  EXPECT_THAT(error_of([&] { all_of(source); }), ::testing::HasSubstr("broken gzip data"));
}

TEST(ByteSource, PeeksWithoutConsuming) {
  const TemporaryFile file(gzipped("sensor,rise_ticks"));
  ByteSource source(file.path());
  EXPECT_TRUE(source.peek(6).starts_with("sensor"));
  EXPECT_TRUE(source.peek(1000).ends_with("rise_ticks"));
  EXPECT_EQ(all_of(source), "sensor,rise_ticks");
}

TEST(ByteSource, SaysWhichFileCannotBeOpened) {
  const std::string message = error_of([] { ByteSource source("/nowhere/at/all.csv"); });
  EXPECT_THAT(message, ::testing::HasSubstr("/nowhere/at/all.csv"));
  EXPECT_THAT(message, ::testing::HasSubstr("No such file"));
}

TEST(ByteSource, RefusesADirectory) {
  EXPECT_THAT(error_of([] { ByteSource source("/"); }), ::testing::HasSubstr("directory"));
}

}  // namespace
}  // namespace pharos::host
