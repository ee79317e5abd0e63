// SPDX-License-Identifier: Apache-2.0
#include "host/device/pair_names.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

class PairNames : public ::testing::Test {
 protected:
  PairNames() {
    root_ = std::filesystem::temp_directory_path() /
            ("pharos-pair-names-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(root_ / "left");
    std::filesystem::create_directories(root_ / "right");
  }
  ~PairNames() override { std::filesystem::remove_all(root_); }
  void add(const std::string& side, const std::string& name) const { std::ofstream(root_ / side / name) << "x"; }
  std::vector<PairName> pairs() const {
    return pair_names((root_ / "left").string(), (root_ / "right").string(), 20.0);
  }
  std::string refusal_in() const {
    return pharos::test::error_of([&] { pair_names_in(root_.string(), 20.0); });
  }
  std::vector<PairName> pairs_without(std::vector<std::string>& alone) const {
    return pair_names((root_ / "left").string(), (root_ / "right").string(), 20.0, &alone);
  }
  void expect_refused(const std::string& word) const {
    try {
      pairs();
      FAIL() << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
  std::filesystem::path root_;
};

TEST_F(PairNames, GoInOrderOfNamesAndByTheRate) {
  for (const char* name : {"b.TIFF", "a.jpg", "c.bmp", "notes.txt"}) {
    add("left", name);
    add("right", name);
  }
  const auto found = pairs();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].stem, "a");
  EXPECT_EQ(found[2].stem, "c");
  EXPECT_DOUBLE_EQ(found[2].time_s, 0.1);
}

TEST_F(PairNames, StampsOfNanosecondsAreTimes) {
  for (const char* name : {"1403715273262142976.png", "1403715273312143104.png"}) {
    add("left", name);
    add("right", name);
  }
  const auto found = pairs();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[1].time_s - found[0].time_s, 0.05, 1e-6);
  EXPECT_NEAR(found[0].time_s, 1403715273.262143, 1e-6);
  EXPECT_EQ(found[0].stamp_ns, 1403715273262142976);
}

TEST_F(PairNames, OfOneDirectoryLieInTwoFoldersOrSideBySide) {
  for (const char* side : {"left", "right"}) add(side, "000001.png");
  EXPECT_EQ(pair_names_in(root_.string(), 20.0).at(0).right, (root_ / "right" / "000001.png").string());
  std::filesystem::remove_all(root_ / "left");
  std::filesystem::remove_all(root_ / "right");
  for (const char* name : {"0002_left.png", "0002_right.png", "0001_left.png", "0001_right.png", "overlay.png"}) {
    add("", name);
  }
  const auto found = pair_names_in(root_.string(), 10.0);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].left, (root_ / "0001_left.png").string());
  EXPECT_EQ(found[1].right, (root_ / "0002_right.png").string());
  EXPECT_DOUBLE_EQ(found[1].time_s, 0.1);
  EXPECT_FALSE(found[0].stamp_ns);
  add("", "0003_left.png");
  EXPECT_NE(refusal_in().find("0003_left.png: has no partner"), std::string::npos) << refusal_in();
  add("", "0000_right.png");
  EXPECT_NE(refusal_in().find("0000_right.png: has no partner"), std::string::npos) << refusal_in();
}

TEST_F(PairNames, ADirectoryWithoutPairsIsNamed) {
  std::filesystem::remove_all(root_ / "left");
  EXPECT_NE(refusal_in().find("holds no .png"), std::string::npos) << refusal_in();
  add("", "0000.png");
  EXPECT_NE(refusal_in().find("holds no pairs"), std::string::npos) << refusal_in();
}

TEST_F(PairNames, AFrameMissingOnOneSideIsNamed) {
  for (const char* name : {"1.png", "2.png", "3.png"}) add("left", name);
  for (const char* name : {"1.png", "3.png"}) add("right", name);
  expect_refused("2.png: has no partner");
}

TEST_F(PairNames, ImagesWithoutPartnerAreLeftOutWhereTheyMayAndKeepTheirTime) {
  for (const char* name : {"1.png", "2.png", "3.png", "4.png"}) add("left", name);
  for (const char* name : {"0.png", "1.png", "3.png", "4.png"}) add("right", name);
  std::vector<std::string> alone;
  const auto found = pairs_without(alone);
  EXPECT_EQ(alone,
            (std::vector<std::string>{(root_ / "right" / "0.png").string(), (root_ / "left" / "2.png").string()}));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].left, (root_ / "left" / "3.png").string());
  EXPECT_EQ(found[1].right, (root_ / "right" / "3.png").string());
  EXPECT_DOUBLE_EQ(found[0].time_s, 0.05);
  EXPECT_DOUBLE_EQ(found[1].time_s, 0.15);
}

// Cameras whose time stamps differ slightly; one camera lost one frame.
TEST_F(PairNames, StampsWithoutPartnerAreLeftOutWhereTheyMay) {
  for (const int ms : {100, 150, 200, 250}) add("left", "1403715273" + std::to_string(ms) + "000000.png");
  for (const int ms : {100, 200, 250}) add("right", "1403715273" + std::to_string(ms) + "300000.png");
  std::vector<std::string> alone;
  const auto found = pairs_without(alone);
  EXPECT_EQ(alone, (std::vector<std::string>{(root_ / "left" / "1403715273150000000.png").string()}));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].left, (root_ / "left" / "1403715273200000000.png").string());
  EXPECT_EQ(found[1].right, (root_ / "right" / "1403715273200300000.png").string());
}

TEST_F(PairNames, FoldersThatShareHardlyAnyNameAreRefusedAllTheSame) {
  for (const char* name : {"1.png", "2.png", "3.png"}) add("left", name);
  for (const char* name : {"3.png", "4.png", "5.png"}) add("right", name);
  std::vector<std::string> alone;
  EXPECT_THROW(pairs_without(alone), InputError);
  EXPECT_TRUE(alone.empty());
}

// Without common names, only the numbers of images can be compared.
TEST_F(PairNames, DifferentNumbersOfImagesAreNamed) {
  for (const char* name : {"l1.png", "l2.png", "l3.png"}) add("left", name);
  for (const char* name : {"r1.png", "r3.png"}) add("right", name);
  expect_refused("3 images");
}

TEST_F(PairNames, ShiftedNamesAreNamed) {
  for (const char* name : {"000000.png", "000001.png", "000002.png"}) add("left", name);
  for (const char* name : {"000001.png", "000002.png", "000003.png"}) add("right", name);
  expect_refused("000000.png: has no partner");
}

TEST_F(PairNames, SidesThatShareNoNameGoByTheirOrder) {
  for (const char* name : {"l1.png", "l2.png"}) add("left", name);
  for (const char* name : {"r7.png", "r8.png"}) add("right", name);
  EXPECT_EQ(pairs().at(1).right, (root_ / "right" / "r8.png").string());
}

TEST_F(PairNames, StampsOutOfStepAreNamed) {
  for (const int k : {10, 11, 12}) {
    add("left", "14037152732621429" + std::to_string(k) + ".png");
    add("right", "14037152732621429" + std::to_string(k + 1) + ".png");
  }
  expect_refused("out of step");
}

TEST_F(PairNames, AFolderWithoutImagesIsNamed) {
  expect_refused("holds no");
  std::filesystem::remove_all(root_ / "left");
  expect_refused("name a folder");
}

}  // namespace
}  // namespace pharos::host
