// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/real_data.hpp"
#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

double ours(const std::vector<Row>& rows, const std::string& words) {
  for (const Row& row : rows) {
    if (row.at("what").find(words) != std::string::npos) return std::stod(row.at("ours"));
  }
  ADD_FAILURE() << "no row with '" << words << "'";
  return 0.0;
}

const Outcome& quick_run() {
  static const Outcome run = pharos("reproduce lighthouse --quick");
  return run;
}

TEST(CliReproduce, PredictsTheSpreadOfStaticSetsAsFigure5) {
  const Outcome& run = quick_run();
  ASSERT_EQ(run.exit_code, 0);
  EXPECT_EQ(first_line(run.out), "item,what,unit,published,ours,ratio,remark,calibrated,motion,both,theirs");
  const auto rows = rows_of(run.out);
  EXPECT_NEAR(ours(rows, "rotation sigma"), 1.0, 0.1);
  EXPECT_NEAR(ours(rows, "position sigma"), 1.0, 0.1);
  // The orders of magnitude that section 4.2 publishes.
  EXPECT_NEAR(std::log10(ours(rows, "rotation precision (23)") / 0.1), 0.0, 0.5);
  EXPECT_NEAR(std::log10(ours(rows, "position precision (23)") / 1.0), 0.0, 0.5);
}

TEST(CliReproduce, GivesTheSameFiguresForTheSameSeed) {
  EXPECT_EQ(pharos("reproduce lighthouse --quick").out, quick_run().out);
}

// In three short flights calibration and motion-aware tracking together are better than the paper's method.
TEST(CliReproduce, FliesTheManoeuvresInFourWays) {
  for (const Row& row : rows_of(quick_run().out)) {
    const bool four = row.at("item") == "table 2";
    if (!four) {
      EXPECT_TRUE(row.at("both").empty());
    }
    if (!four || row.at("what").find("median of runs") == std::string::npos) continue;
    if (row.at("what").find("position RMS") == std::string::npos) continue;
    EXPECT_LT(std::stod(row.at("calibrated")), std::stod(row.at("theirs")));
    EXPECT_LT(std::stod(row.at("both")), 0.5 * std::stod(row.at("calibrated")));
    EXPECT_EQ(row.at("both"), row.at("ours"));
    EXPECT_LT(std::stod(row.at("both")), 3.0);
  }
}

TEST(CliReproduce, PrintsAMarkdownTable) {
  const Outcome run = pharos("reproduce lighthouse --quick --markdown");
  EXPECT_THAT(
      run.out,
      StartsWith(
          "| item | what | published or asked | theirs rerun | ours | ratio | remark | + calibration | + motion | both "
          "|\n|---|"));
  EXPECT_THAT(run.out, HasSubstr("| table 2 | run 1: rotation RMS | 0.96 deg |"));
}

TEST(CliReproduce, TurnsBodiesDrawnAtRandom) {
  const Outcome run = pharos("reproduce slam --bodies 1 --seed 8 --turn-deg 3");
  ASSERT_EQ(run.exit_code, 0);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("seed"), "8");
  EXPECT_EQ(rows[0].at("symmetric"), "1");
  EXPECT_EQ(rows[0].at("pairs"), "4");
  EXPECT_EQ(rows[0].at("placed"), "4");
  EXPECT_LT(std::stod(rows[0].at("rmse_deg")), 0.25);
  EXPECT_EQ(rows[2].at("seed"), "median");
  EXPECT_EQ(pharos("reproduce slam --bodies 1 --turn-deg 0").exit_code, 2);
}

TEST(CliReproduce, SaysWhereRecordingsAreMissing) {
  const Outcome run = pharos("reproduce lighthouse --recordings /nowhere");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("/nowhere/hmd_static.edges.csv.gz"));
}

TEST(CliReproduce, RealRecordingsReachWhatIsAskedOfThem) {
  PHAROS_NEEDS_DATA("lighthouse");
  const Outcome run = pharos("reproduce lighthouse --recordings " + test::real_data("lighthouse").string());
  ASSERT_EQ(run.exit_code, 0);
  std::size_t asked = 0;
  for (const Row& row : rows_of(run.out)) {
    const std::string& bound = row.at("published");
    if (bound.size() < 4) continue;
    ++asked;
    const double limit = std::stod(bound.substr(3));
    if (bound.starts_with("<=")) {
      EXPECT_LE(std::stod(row.at("ours")), limit) << row.at("item") << ": " << row.at("what");
    } else {
      EXPECT_GE(std::stod(row.at("ours")), limit) << row.at("item") << ": " << row.at("what");
    }
  }
  EXPECT_EQ(asked, 22u);
}

}  // namespace
}  // namespace pharos::cli_test
