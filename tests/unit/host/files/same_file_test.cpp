// SPDX-License-Identifier: Apache-2.0
#include "host/files/same_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/temporary_folder.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

TEST(SameFile, IsToldByDeviceAndInode) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  fs::create_symlink("file", folder.path("link"));
  fs::create_hard_link(file, folder.path("hard"));
  fs::create_directory(folder.path("inner"));
  EXPECT_TRUE(same_file(file, folder.path("link")));
  EXPECT_TRUE(same_file(file, folder.path("hard")));
  EXPECT_TRUE(same_file(file, folder.path("inner/../file")));
  EXPECT_TRUE(same_file(folder.path().string(), folder.path("inner/..")));
  EXPECT_FALSE(same_file(file, folder.write("other", "")));
  EXPECT_FALSE(same_file(file, folder.path("inner")));
}

TEST(SameFile, IsToldByNameWhereThereIsNoneYet) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(same_file(folder.path("new"), folder.path("./new")));
  EXPECT_FALSE(same_file(folder.path("new"), folder.path("newer")));
  EXPECT_FALSE(same_file(folder.path("new"), folder.write("old", "")));
}

TEST(SameFile, IsNeitherAStreamNorADevice) {
  EXPECT_FALSE(same_file("-", "-"));
  EXPECT_FALSE(same_file("", ""));
  EXPECT_FALSE(same_file("/dev/null", "/dev/null"));
}

}  // namespace
}  // namespace pharos::host
