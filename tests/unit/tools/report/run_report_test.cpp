// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/run_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "host/support/input_error.hpp"
#include "tools/evaluation/report/store.hpp"

namespace pharos::tools::report {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A part that counts its runs and may fail.
struct Planted {
  int runs = 0;
  bool fails = false;

  Part part(const std::string& id) {
    return {id, [](const PartSettings&) { return std::string("pharos reproduce <planted>"); },
            [this](const PartSettings&, const fs::path& folder) {
              ++runs;
              std::ofstream(folder / "a.svg") << "<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>";
              if (fails) throw host::InputError("killed");
              ComparisonRow row{"figure 8a", "an angle", "deg", "< 1", 0.1 + 0.2, "a < b & c"};
              row.theirs = 0.75;
              PartResult result;
              result.rows = {row, {"noise", "without an answer", "", "", std::nullopt, "why"}};
              result.pictures = {{"figure 8a", "curves", "a.svg"}};
              return result;
            }};
  }
};

class RunReport : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("report_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  ReportOptions options(bool quick = true, std::uint64_t seed = 1) const {
    return {folder_.string(), {quick, seed}, {}, {}, {}};
  }
  fs::path folder_;
};

TEST_F(RunReport, KeepsAFinishedPartAndRunsItAgainForOtherSettings) {
  Planted planted;
  const std::vector<Part> parts = {planted.part("ring2")};
  run_report(parts, options());
  const std::string first = text_of(folder_ / "report.html");
  run_report(parts, options());
  EXPECT_EQ(planted.runs, 1);
  EXPECT_EQ(text_of(folder_ / "report.html"), first);
  run_report(parts, options(true, 2));
  EXPECT_EQ(planted.runs, 2);
  run_report(parts, options(false, 2));
  EXPECT_EQ(planted.runs, 3);
}

TEST_F(RunReport, AnInterruptedRunLeavesTheFinishedPartsAndGoesOnThere) {
  Planted first, second;
  const std::vector<Part> parts = {first.part("ring2"), second.part("line")};
  second.fails = true;
  EXPECT_THROW(run_report(parts, options()), host::InputError);
  EXPECT_THAT(text_of(folder_ / "report.html"), HasSubstr("Part line was not run"));
  second.fails = false;
  run_report(parts, options());
  EXPECT_EQ(first.runs, 1);
  EXPECT_EQ(second.runs, 2);
  EXPECT_THAT(text_of(folder_ / "report.html"), Not(HasSubstr("Part line was not run")));
}

TEST_F(RunReport, SaysOfEachPartWhetherItWasQuick) {
  Planted first, second;
  const std::vector<Part> parts = {first.part("ring2"), second.part("line")};
  ReportOptions mixed = options(false);
  mixed.quick = {"line"};
  run_report(parts, mixed);
  const std::string text = text_of(folder_ / "report.md");
  EXPECT_THAT(text, HasSubstr("part line, quick:"));
  EXPECT_THAT(text, HasSubstr("part ring2:"));
  run_report({second.part("line")}, options(true));  // the same part with the same settings
  EXPECT_EQ(second.runs, 1);
}

TEST_F(RunReport, TheSectionOfAMarkdownFileIsReplacedAndNothingElse) {
  fs::create_directories(folder_);
  const std::string file = (folder_ / "RESULTS.md").string();
  const std::string before = "# Results\n\nWords.\n\n<!-- five papers: begin -->\n",
                    after = "<!-- five papers: end -->\nend\n";
  std::ofstream(file) << before << "stale\n" << after;
  Planted planted;
  ReportOptions with = options();
  with.results = file;
  run_report({planted.part("ring2")}, with);
  const std::string text = text_of(file);
  EXPECT_TRUE(text.starts_with(before));
  EXPECT_TRUE(text.ends_with(after));
  EXPECT_THAT(text, Not(HasSubstr("stale")));
  EXPECT_THAT(text, HasSubstr("\n## Five papers"));
  EXPECT_THAT(text, HasSubstr("| figure 8a: an angle | deg | < 1 | 0.75 | 0.3 | 0.4 | a < b & c |"));
  EXPECT_THAT(text, HasSubstr("| noise: without an answer |"));
  run_report({planted.part("ring2")}, with);
  EXPECT_EQ(text_of(file), text);
}

TEST(Comparison, AFigureHasAsManyDecimalsAsThePublishedOne) {
  EXPECT_EQ(rounded_as(608.5804, "608.61"), "608.58");
  EXPECT_EQ(rounded_as(4160.96, "4160.9610"), "4160.9600");
  EXPECT_EQ(rounded_as(-0.19904, "-0.1991"), "-0.1990");
  EXPECT_EQ(rounded_as(0.000123456, "0.1991"), "0.000123");
  EXPECT_EQ(rounded_as(0.0, "0.12"), "0");
  for (const char* words : {"", "< 0.50", "best", "1e-3", "12"}) EXPECT_EQ(rounded_as(30.00012, words), "30");
}

TEST_F(RunReport, AFileWithoutTheSectionIsRefusedBeforeAnythingRuns) {
  fs::create_directories(folder_);
  const std::string file = (folder_ / "RESULTS.md").string();
  const std::string begin = "<!-- five papers: begin -->\n", end = "<!-- five papers: end -->\n";
  Planted planted;
  ReportOptions with = options();
  with.results = file;
  for (const std::string& document : {std::string(), begin, end + begin, begin + begin + end, "x" + begin + end}) {
    std::ofstream(file) << document;
    EXPECT_THROW(run_report({planted.part("ring2")}, with), host::InputError);
    EXPECT_EQ(text_of(file), document);
  }
  fs::remove(file);
  EXPECT_THROW(run_report({planted.part("ring2")}, with), host::InputError);
  EXPECT_EQ(planted.runs, 0);
}

TEST_F(RunReport, APartWhosePicturesOrTableAreGoneIsRunAgain) {
  Planted planted;
  const std::vector<Part> parts = {planted.part("ring2")};
  run_report(parts, options());
  fs::remove(folder_ / "ring2" / "a.svg");
  run_report(parts, options());
  EXPECT_EQ(planted.runs, 2);
  std::ofstream(folder_ / "ring2" / "part.json") << "{\"format\": 1, \"key\": [";
  run_report(parts, options());
  EXPECT_EQ(planted.runs, 3);
}

TEST_F(RunReport, KeptFiguresAreTheSameToTheLastBit) {
  Planted planted;
  run_report({planted.part("ring2")}, options());
  const auto kept = kept_part(folder_ / "ring2", key_of("ring2", {true, 1}));
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->result.rows[0].ours, 0.1 + 0.2);
  EXPECT_EQ(kept->result.rows[1].ours, std::nullopt);
  EXPECT_EQ(kept->result.rows[1].remark, "why");
}

TEST_F(RunReport, APictureOutsideOfThePartsFolderIsNotRead) {
  Planted planted;
  run_report({planted.part("ring2")}, options());
  std::string text = text_of(folder_ / "ring2" / "part.json");
  text.replace(text.find("a.svg"), 5, "../report.md");
  std::ofstream(folder_ / "ring2" / "part.json") << text;
  EXPECT_FALSE(kept_part(folder_ / "ring2", key_of("ring2", {true, 1})).has_value());
}

TEST_F(RunReport, ThePageIsWholeAndNeedsNoNetwork) {
  Planted planted;
  EXPECT_FALSE(run_report({planted.part("ring2")}, options()));  // figures 7, 9 and 10 are not there
  const std::string page = text_of(folder_ / "report.html");
  EXPECT_THAT(page, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("paper 001, figure 10: no picture"));
  EXPECT_THAT(page, HasSubstr("pharos reproduce &lt;planted&gt;"));
  for (const char* outside : {"src=\"http", "href=\"http", "<script", "<link", "url("}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
}

}  // namespace
}  // namespace pharos::tools::report
