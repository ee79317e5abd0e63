// SPDX-License-Identifier: Apache-2.0
#include "tools/slam/frame_names.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

class FrameNames : public ::testing::Test {
 protected:
  FrameNames() {
    root_ = std::filesystem::temp_directory_path() /
            ("pharos-frame-names-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(root_ / "left");
    std::filesystem::create_directories(root_ / "right");
  }
  ~FrameNames() override { std::filesystem::remove_all(root_); }
  void add(const std::string& side, const std::string& name) const { std::ofstream(root_ / side / name) << "x"; }
  std::vector<PairName> pairs() const {
    return pair_names((root_ / "left").string(), (root_ / "right").string(), 20.0);
  }
  void expect_refused(const std::string& word) const {
    try {
      pairs();
      FAIL() << word;
    } catch (const host::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
  std::filesystem::path root_;
};

TEST_F(FrameNames, GoInOrderOfNamesAndByTheRate) {
  for (const char* name : {"b.png", "a.pgm", "c.png", "notes.txt"}) {
    add("left", name);
    add("right", name);
  }
  const auto found = pairs();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].stem, "a");
  EXPECT_EQ(found[2].stem, "c");
  EXPECT_DOUBLE_EQ(found[2].time_s, 0.1);
}

TEST_F(FrameNames, StampsOfNanosecondsAreTimes) {
  for (const char* name : {"1403715273262142976.png", "1403715273312143104.png"}) {
    add("left", name);
    add("right", name);
  }
  const auto found = pairs();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[1].time_s - found[0].time_s, 0.05, 1e-6);
  EXPECT_NEAR(found[0].time_s, 1403715273.262143, 1e-6);
}

TEST_F(FrameNames, AFrameMissingOnOneSideIsNamed) {
  for (const char* name : {"1.png", "2.png", "3.png"}) add("left", name);
  for (const char* name : {"1.png", "3.png"}) add("right", name);
  expect_refused("3 images");
}

TEST_F(FrameNames, StampsOutOfStepAreNamed) {
  for (const int k : {10, 11, 12}) {
    add("left", "14037152732621429" + std::to_string(k) + ".png");
    add("right", "14037152732621429" + std::to_string(k + 1) + ".png");
  }
  expect_refused("out of step");
}

TEST_F(FrameNames, AFolderWithoutImagesIsNamed) {
  expect_refused("holds no");
  std::filesystem::remove_all(root_ / "left");
  expect_refused("name a folder");
}

}  // namespace
}  // namespace pharos::tools
