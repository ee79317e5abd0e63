// SPDX-License-Identifier: Apache-2.0
// sim approach -> fuse, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliFuse : public ::testing::Test {
 protected:
  void approach(const std::string& name) {
    dir_ = folder_.path(name);
    const Outcome sim = pharos("sim approach " + std::string(PHAROS_SCENARIOS) + "/approach_" + name +
                               ".toml --seed 5 --output " + dir_);
    ASSERT_EQ(sim.exit_code, 0) << sim.err;
  }
  std::string all_sources() const {
    std::string tables;
    for (const char* source : {"lighthouse", "tof", "ring2", "slam"}) tables += dir_ + '/' + source + ".csv ";
    return tables + "--mounting " + dir_ + "/mounting.toml ";
  }

  const Folder folder_;
  std::string dir_;
};

TEST_F(CliFuse, AnApproachStaysWithinItsProtectionLevels) {
  approach("nominal");
  const Outcome run = pharos("fuse " + all_sources() + "--truth " + dir_ + "/truth.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("truth outside of the protection level in 0 of"));
  double square_deg = 0.0, square_mm = 0.0;
  std::size_t fused = 0, after_start = 0;
  for (const Row& row : rows_of(run.out)) {
    if (row.at("mode") != "fused") {
      EXPECT_EQ(row.at("tx_m").empty(), row.at("mode") == "searching" || row.at("mode") == "lost");
      if (fused > 0) ++after_start;
      continue;
    }
    ++fused;
    const double deg = std::stod(row.at("error_rot_deg")), mm = std::stod(row.at("error_pos_mm"));
    square_deg += deg * deg;
    square_mm += mm * mm;
    EXPECT_LT(deg, 5.0 * std::stod(row.at("sigma_rot_deg"))) << row.at("time_s");
    EXPECT_LT(mm, 5.0 * std::stod(row.at("sigma_pos_mm"))) << row.at("time_s");
  }
  ASSERT_GT(fused, 3000U);
  EXPECT_LE(after_start, fused / 200);  // available for 99.5 % of the time
  EXPECT_LT(square_deg / static_cast<double>(fused), 0.1 * 0.1);
  EXPECT_LT(square_mm / static_cast<double>(fused), 2.0 * 2.0);
}

TEST_F(CliFuse, FaultySourcesAreExcludedAndTheLevelHolds) {
  approach("faults");
  const Outcome run = pharos("fuse " + all_sources() + "--truth " + dir_ + "/truth.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("truth outside of the protection level in 0 of"));
  std::size_t excluded = 0;
  for (const Row& row : rows_of(run.out)) excluded += row.at("excluded").empty() ? 0U : 1U;
  EXPECT_GT(excluded, 0U);
}

TEST_F(CliFuse, TumHasALineForEachStateAndNothingElse) {
  approach("nominal");
  const Outcome run = pharos("fuse " + all_sources() + "--format tum");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(count_lines(run.out), 3000U);
  EXPECT_THAT(run.out, Not(HasSubstr("nan")));
}

TEST_F(CliFuse, AnotherRigsMountingIsRefused) {
  const std::string table = folder_.write(
      "lighthouse.csv",
      "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n0.5,1,0,0,0,0,0,1,0.1,1,ok\n");
  approach("nominal");
  const Outcome run = pharos("fuse sonar=" + table + " --mounting " + dir_ + "/mounting.toml");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("sonar"));
  EXPECT_EQ(count_lines(run.err), 1U) << run.err;
}

}  // namespace
}  // namespace pharos::cli_test
