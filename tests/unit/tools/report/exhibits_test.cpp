// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/exhibits.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tools/evaluation/reproduce/ring2/sweeps.hpp"

namespace pharos::tools::report {
namespace {

// Counted in the papers.
struct Count {
  int tables, figures;
};
const std::map<std::string_view, Count> kPrinted = {
    {"000", {3, 10}}, {"001", {0, 10}}, {"002", {2, 7}}, {"003", {2, 11}}, {"004", {1, 5}}};

const Exhibit& exhibit(std::string_view paper, std::string_view label) {
  for (const Exhibit& one : exhibits()) {
    if (one.paper == paper && one.label == label) return one;
  }
  throw std::out_of_range(std::string(label));
}

TEST(Exhibits, HaveEveryNumberedTableAndFigureOnce) {
  std::set<std::pair<std::string_view, std::string_view>> found;
  for (const Exhibit& one : exhibits()) {
    EXPECT_TRUE(found.emplace(one.paper, one.label).second) << one.paper << " " << one.label;
    EXPECT_FALSE(one.caption.empty()) << one.paper << " " << one.label;
  }
  std::size_t printed = 0;
  for (const auto& [paper, count] : kPrinted) {
    for (int k = 1; k <= count.tables; ++k) EXPECT_NO_THROW(exhibit(paper, "table " + std::to_string(k))) << paper << k;
    for (int k = 1; k <= count.figures; ++k) {
      EXPECT_NO_THROW(exhibit(paper, "figure " + std::to_string(k))) << paper << " " << k;
    }
    printed += static_cast<std::size_t>(count.tables + count.figures);
  }
  EXPECT_EQ(found.size(), printed);
}

TEST(Exhibits, AreComputedOrSayWhyNot) {
  for (const Exhibit& one : exhibits()) {
    if (one.parts.empty()) {
      EXPECT_FALSE(one.remark.empty()) << one.paper << " " << one.label;
    } else {
      EXPECT_TRUE(one.picture || !one.rows.empty()) << one.paper << " " << one.label;
    }
    if (one.label.starts_with("table") && !one.parts.empty()) {
      EXPECT_FALSE(one.rows.empty()) << one.paper << " " << one.label;
    }
  }
}

TEST(Exhibits, ARowBelongsToTheLabelWithWhichItBegins) {
  const Exhibit& one = exhibit("001", "figure 1");
  EXPECT_TRUE(is_of(one, "figure 1"));
  EXPECT_TRUE(is_of(one, "figure 1b"));
  EXPECT_TRUE(is_of(one, "figure 1, left"));
  EXPECT_FALSE(is_of(one, "figure 10"));
  EXPECT_FALSE(is_of(one, "section 3"));
}

TEST(Exhibits, AMissingRowOrPictureIsNamed) {
  Exhibit one{"001", "table 9", "planted", {"part"}, "", true, {"run 1", "run 2"}};
  PartResult result;
  result.rows.push_back({"table 9", "run 1: RMS", "deg", "1", 2.0, ""});
  EXPECT_EQ(missing_of(one, result), (std::vector<std::string>{"no picture", "no row 'run 2'"}));
  result.pictures.push_back({"table 9", "", "a.svg"});
  // A row without figures does not count, unless it says why.
  result.rows.push_back({"table 9", "run 2: RMS", "deg", "1", std::nullopt, ""});
  EXPECT_EQ(missing_of(one, result), (std::vector<std::string>{"no row 'run 2'"}));
  result.rows.back().remark = "left out by --quick";
  EXPECT_TRUE(missing_of(one, result).empty());
  one.parts.clear();
  one.remark = "";
  EXPECT_EQ(missing_of(one, {}).size(), 1U);
}

TEST(Exhibits, PaperOneHasAllOfItsFigures) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "paper_one";
  std::filesystem::create_directories(folder);
  const PartResult result = ring2_part().run({true, 3}, folder);
  for (const Exhibit& one : exhibits()) {
    if (one.paper != "001") continue;
    EXPECT_TRUE(missing_of(one, one.parts.empty() ? PartResult{} : result).empty()) << one.label;
  }
  for (const Picture& picture : result.pictures) EXPECT_TRUE(std::filesystem::exists(folder / picture.file));
}

// What paper 001 says of its figure 9: two cameras better than one, about either axis.
TEST(Exhibits, PaperOnesMethodIsBetterWithTwoCamerasThanWithOne) {
  int gains = 0;
  for (const ComparisonRow& row : reproduce_ring2_sweeps(1).rows) {
    if (!row.what.starts_with("two cameras better")) continue;
    ++gains;
    EXPECT_GT(row.theirs.value_or(-1.0), 0.0) << row.what;
  }
  EXPECT_EQ(gains, 6);
}

}  // namespace
}  // namespace pharos::tools::report
