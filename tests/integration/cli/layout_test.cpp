// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kPoses =
    "pose,qw,qx,qy,qz,tx_m,ty_m,tz_m\n"
    "a,0.1,0.975,0.15,0.12,0.2,0.1,2\nb,0.15,0.955,-0.22,0.12,-0.5,0.1,3\nc,0.05,0.905,0.1,0.41,0.1,-0.4,2.5\n";
constexpr const char* kCube =
    "OFF\n8 6 12\n0 0 0\n0.1 0 0\n0.1 0.1 0\n0 0.1 0\n0 0 0.1\n0.1 0 0.1\n0.1 0.1 0.1\n0 0.1 0.1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

/// A cube, three poses near facing, and a file for the result. Quaternions are normalised by the reader.
struct Bench {
  Folder folder;
  std::string body = folder.write("cube.off", kCube);
  std::string poses = folder.write("poses.csv", kPoses);
  std::string target = folder.path("target.csv");

  Outcome layout(const std::string& more) const {
    return pharos("layout --body " + body + " --poses " + poses + " --output " + target + " --starts 1 " + more);
  }
};

TEST(CliLayout, WritesATargetWorthWhatItSays) {
  const Bench bench;
  const std::string picture = bench.folder.path("layout.svg");
  const Outcome run = bench.layout("--sensors 8 --incidence-deg 60 --plot " + picture);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Row gain = rows_of(run.out).at(0);
  const auto rows = rows_of(pharos("precision --target " + bench.target + " --poses " + bench.poses).out);
  double adop = 0.0;
  for (const Row& row : rows) adop += std::stod(row.at("adop_deg_per_rad")) / static_cast<double>(rows.size());
  EXPECT_NEAR(std::stod(gain.at("adop_deg_per_rad")) / adop, 1.0, 1e-9);
  EXPECT_EQ(gain.at("measured"), "3");
  EXPECT_EQ(rows_of(content_of(bench.target)).size(), 8u);
  EXPECT_THAT(content_of(picture), StartsWith("<svg"));

  // Compared with itself nothing is worse.
  const std::string found = bench.folder.write("present.csv", content_of(bench.target));
  const Row again = rows_of(bench.layout("--sensors 8 --target " + found).out).at(0);
  EXPECT_EQ(again.at("present_adop_deg_per_rad"), gain.at("adop_deg_per_rad"));
}

TEST(CliLayout, LeavesTheOldTargetWhereThereIsNoAnswer) {
  Bench bench;
  bench.folder.write("target.csv", "old");
  EXPECT_EQ(bench.layout("--sensors 32 --spacing-mm 90").exit_code, 1);
  bench.poses = bench.folder.write("behind.csv", "pose,qw,qx,qy,qz,tx_m,ty_m,tz_m\na,1,0,0,0,0,0,-2\n");
  const Outcome behind = bench.layout("--sensors 8");
  EXPECT_EQ(behind.exit_code, 1);
  EXPECT_THAT(behind.err, HasSubstr("no face of the body is seen"));
  EXPECT_EQ(content_of(bench.target), "old");
}

TEST(CliLayout, EndsWith2OnWrongUse) {
  Bench bench;
  EXPECT_EQ(bench.layout("--sensors 33").exit_code, 2);
  EXPECT_EQ(bench.layout("--sensors 3").exit_code, 2);
  EXPECT_EQ(bench.layout("--sensors 8 --objective best").exit_code, 2);
  bench.body = bench.poses;
  const Outcome run = bench.layout("--sensors 8");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("not an OFF file"));
}

}  // namespace
}  // namespace pharos::cli_test
