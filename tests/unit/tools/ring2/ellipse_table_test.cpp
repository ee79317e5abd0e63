// SPDX-License-Identifier: Apache-2.0
#include "tools/ring2/ellipse_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "host/cameras/rig_file.hpp"
#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/sim/ring2/ring2_writer.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

using Folder = pharos::test::TemporaryFolder;

constexpr const char* kHeader = "view,feature,cx_px,cy_px,a_px,b_px,theta_rad,sigma_px,points\n";

std::string error_message_of(const std::string& rows) {
  const Folder folder;
  return pharos::test::error_of([&] { read_ellipse_table(host::ByteSource(folder.write("e.csv", kHeader + rows))); });
}

TEST(EllipseTable, ReadsProblemsInTheOrderOfTheirFirstRows) {
  const Folder folder;
  const std::string path = folder.write("e.csv",
                                        "problem,view,feature,cx_px,cy_px,a_px,b_px,theta_rad\n"
                                        "b,left,ring,600,500,100,90,0.1\na,right,nozzle,600,500,30,20,0.1\n"
                                        "b,right,ring,610,500,20,90,0\n");
  const EllipseTable table = read_ellipse_table(host::ByteSource(path));
  EXPECT_TRUE(table.has_problems);
  ASSERT_EQ(table.problems.size(), 2U);
  EXPECT_EQ(table.problems[0].name, "b");
  ASSERT_TRUE(table.problems[0].contours[1][0].has_value());
  EXPECT_EQ(table.problems[0].contours[1][0]->ellipse.a_px, 90.0);  // the longer axis, whatever its column
  EXPECT_FALSE(table.problems[0].contours[0][1].has_value());
  EXPECT_TRUE(table.problems[1].contours[1][1].has_value());
}

TEST(EllipseTable, NamesWhatIsWrongWithARow) {
  EXPECT_THAT(error_message_of("middle,ring,1,1,9,9,0,,\n"), AllOf(HasSubstr("line 2"), HasSubstr("left nor right")));
  EXPECT_THAT(error_message_of("left,hole,1,1,9,9,0,,\n"), HasSubstr("ring nor nozzle"));
  EXPECT_THAT(error_message_of("left,ring,1,1,-9,9,0,,\n"), AllOf(HasSubstr("a_px"), HasSubstr("semi-axis")));
  EXPECT_THAT(error_message_of("left,ring,1,1,9,nan,0,,\n"), HasSubstr("b_px"));
  EXPECT_THAT(error_message_of("left,ring,1,1,9,9,0,0,\n"), HasSubstr("sigma_px"));
  EXPECT_THAT(error_message_of("left,ring,1,1,9,9,0,0.1,3\n"), HasSubstr("at least 5"));
  EXPECT_THAT(error_message_of("left,ring,1,1,9,9,0,,\nleft,ring,1,1,9,9,0,,\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("given before")));
}

TEST(EllipseTable, WhatIsSimulatedIsReadAndAnsweredWithTheTruth) {
  const Folder folder;
  sim::Ring2Scenario scenario = sim::read_ring2_scenario(std::string(PHAROS_SCENARIOS) + "/stereo_attitudes.toml", 5);
  scenario.render = false;
  sim::write_ring2_pairs(scenario, 5, folder.path("out"), [] {});
  const host::RigFile file = host::read_rig_file(folder.path("out/rig.toml"));
  ring2::Rig rig;
  rig.views[0] = {file.left.intrinsics, file.left.pose()};
  rig.views[1] = {file.right.intrinsics, file.right.pose()};
  const EllipseTable table = read_ellipse_table(host::ByteSource(folder.path("out/ellipses.csv")));
  ASSERT_EQ(table.problems.size(), 100U);
  for (std::size_t k = 0; k < table.problems.size(); ++k) {
    const auto estimate = ring2::solve_ring2(rig, table.problems[k].contours);
    ASSERT_TRUE(estimate.ok());
    EXPECT_LT((estimate->normal - scenario.target_at(k).normal).norm(), 1e-8);
    EXPECT_LT((estimate->ring_centre_m - scenario.target_at(k).ring_centre_m).norm(), 1e-8);
  }
}

TEST(Ring2Scenario, IsReadStrictly) {
  const auto complaint = [](const std::string& text) -> std::string {
    return pharos::test::error_of([&] { sim::parse_ring2_scenario(text, "s.toml", 1); });
  };
  EXPECT_THAT(complaint(""), HasSubstr("poses"));
  EXPECT_THAT(complaint("poses = [[0, 0, 3, 0, 0]]\nblurr_px = 1"), HasSubstr("blurr_px"));
  EXPECT_THAT(complaint("poses = [[0, 0, -3, 0, 0]]"), HasSubstr("ahead of the rig"));
  EXPECT_THAT(complaint("poses = [[0, 0, 3, 0, 0]]\n[rig]\ndistortion = [0.1, 0, 0, 0, 0]"), HasSubstr("render"));
  EXPECT_EQ(complaint("poses = [[0, 0, 3, 0, 0]]"), "");
}

}  // namespace
}  // namespace pharos::tools
