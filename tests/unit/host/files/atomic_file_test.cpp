// SPDX-License-Identifier: Apache-2.0
#include "host/files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_folder.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class AtomicFileTest : public ::testing::Test {
 protected:
  std::string text(const std::string& name) const {
    const test::Bytes bytes = test::content(folder.path(name));
    return {bytes.begin(), bytes.end()};
  }
  mode_t mode(const std::string& name) const {
    struct stat about {};
    EXPECT_EQ(::stat(folder.path(name).c_str(), &about), 0);
    return about.st_mode & 07777;
  }

  test::TemporaryFolder folder;
};

TEST_F(AtomicFileTest, ShowsNothingUntilItIsCommitted) {
  folder.write("table.csv", "old");
  AtomicFile file(folder.path("table.csv"));
  file.write("new");
  std::fflush(file.stream());
  EXPECT_EQ(text("table.csv"), "old");
  file.commit(AtomicFile::Sync::kToDisk);
  EXPECT_EQ(text("table.csv"), "new");
  EXPECT_EQ(folder.files().size(), 1u);
}

TEST_F(AtomicFileTest, LeavesNothingBehindWithoutCommit) {
  folder.write("table.csv", "old");
  { AtomicFile(folder.path("table.csv")).write("half"); }
  { AtomicFile(folder.path("other.csv")).write("half"); }
  EXPECT_EQ(text("table.csv"), "old");
  EXPECT_EQ(folder.files().size(), 1u);
}

TEST_F(AtomicFileTest, KeepsTheModeAndGivesANewFileWhatUmaskLeaves) {
  folder.write("secret.toml", "old");
  fs::permissions(folder.path("secret.toml"), fs::perms::owner_read | fs::perms::owner_write);
  write_file(folder.path("secret.toml"), "new");
  EXPECT_EQ(mode("secret.toml"), 0600u);
  const mode_t before = ::umask(027);
  write_file(folder.path("table.csv"), "new");
  ::umask(before);
  EXPECT_EQ(mode("table.csv"), 0640u);
}

TEST_F(AtomicFileTest, ReplacesALinkAndDoesNotFollowIt) {
  folder.write("mine", "mine");
  fs::create_symlink("mine", folder.path("link"));
  fs::create_symlink("nowhere", folder.path("dangling"));
  write_file(folder.path("link"), "new");
  write_file(folder.path("dangling"), "new");
  EXPECT_EQ(text("mine"), "mine");
  EXPECT_FALSE(fs::is_symlink(folder.path("link")));
  EXPECT_EQ(text("link"), "new");
  EXPECT_FALSE(fs::exists(folder.path("nowhere")));
}

TEST_F(AtomicFileTest, TouchesNoFileOfASimilarName) {
  for (const char* name : {"table.csv.new", "table.csv~", ".table.csv.tmp"}) folder.write(name, "mine");
  fs::create_symlink("mine", folder.path("table.csv.tmp"));
  write_file(folder.path("table.csv"), "new");
  for (const char* name : {"table.csv.new", "table.csv~", ".table.csv.tmp"}) EXPECT_EQ(text(name), "mine");
  EXPECT_FALSE(fs::exists(folder.path("mine")));
}

TEST_F(AtomicFileTest, WritesDevicesInPlace) {
  write_file("/dev/null", "nothing");
  EXPECT_EQ(pharos::test::error_of([] { require_writable("/dev/stdout"); }), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(pharos::test::error_of([] { write_file("/dev/full", "something"); }), HasSubstr("No space left"));
}

TEST_F(AtomicFileTest, NamesWhatCannotBeWritten) {
  for (const std::string& path : {folder.path("no/such"), folder.path().string(), std::string(), std::string(".")}) {
    const std::string error = pharos::test::error_of([&] { AtomicFile file(path); });
    EXPECT_THAT(error, HasSubstr("cannot be written")) << path;
    EXPECT_THAT(error, ::testing::StartsWith(path)) << path;
  }
  EXPECT_TRUE(folder.files().empty());
}

TEST_F(AtomicFileTest, AsksWithoutChangingAnything) {
  require_writable(folder.path("table.csv"));
  EXPECT_TRUE(folder.files().empty());
  EXPECT_THROW(require_writable(folder.path("no/such")), InputError);
}

TEST_F(AtomicFileTest, TwoOfOnePathDoNotDisturbEachOther) {
  AtomicFile first(folder.path("table.csv"));
  AtomicFile second(folder.path("table.csv"));
  first.write("first");
  second.write("second");
  second.commit();
  first.commit();
  EXPECT_EQ(text("table.csv"), "first");
  EXPECT_EQ(folder.files().size(), 1u);
}

}  // namespace
}  // namespace pharos::host
