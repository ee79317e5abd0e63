// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tools/evaluation/report/exhibits.hpp"
#include "tools/evaluation/reproduce/slam/slam_parts.hpp"
#include "tools/evaluation/reproduce/slam/table_one.hpp"

namespace pharos::tools::report {
namespace {

TEST(SlamParts, HaveEveryTableAndFigureOfPaperFour) {
  PartResult all;
  for (const Part& part : slam_parts()) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("paper_four_" + part.id);
    std::filesystem::create_directories(folder);
    const PartResult result = part.run({true, 1}, folder);
    all.rows.insert(all.rows.end(), result.rows.begin(), result.rows.end());
    all.pictures.insert(all.pictures.end(), result.pictures.begin(), result.pictures.end());
  }
  for (const Exhibit& one : exhibits()) {
    if (one.paper != "004") continue;
    for (const std::string& words : missing_of(one, one.parts.empty() ? PartResult{} : all)) {
      ADD_FAILURE() << one.label << ": " << words;
    }
  }
}

// Half a turn with the paper's 20 keyframes: what is dropped must neither bend the rest nor leave its sigmas too small.
TEST(SlamParts, TwentyKeyframesOverHalfATurnStateTheirError) {
  TableOneOptions options;
  options.turns_deg = {180.0};
  options.runs = {"good-20-keyframes"};
  options.povray = false;
  const auto rows = reproduce_table_one(options).rows;
  const auto figure = [&rows](const std::string& what) {
    for (const ComparisonRow& row : rows) {
      if (row.item.starts_with("table 1") && row.what.starts_with(what)) return row.ours.value_or(1e9);
    }
    return 1e9;
  };
  EXPECT_LT(figure("attitude RMSE"), 0.181);  // as printed
  EXPECT_LT(figure("attitude errors over stated ones"), 4.0);
  EXPECT_EQ(figure("frames without a pose"), 0.0);
}

// What an interrupted run has rendered is read again by the next one: same rows.
TEST(SlamParts, KeptFramesGiveTheSameRows) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "paper_four_again";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "part");
  const Part part = slam_parts().front();
  const PartResult rendered = part.run({true, 2}, folder / "part");
  const auto count = [&folder] {
    const std::filesystem::directory_iterator files(folder / "frames-good");
    return std::distance(begin(files), end(files));
  };
  EXPECT_EQ(count(), 2 * 61 + 1);  // 30 deg, and the key
  const PartResult read = part.run({true, 2}, folder / "part");
  EXPECT_EQ(count(), 2 * 61 + 1);
  ASSERT_EQ(read.rows.size(), rendered.rows.size());
  for (std::size_t k = 0; k < read.rows.size(); ++k) {
    EXPECT_EQ(read.rows[k].what, rendered.rows[k].what);
    EXPECT_EQ(read.rows[k].ours, rendered.rows[k].ours) << read.rows[k].what;
  }
  std::ofstream(folder / "frames-good" / "key") << "of another program\n";
  std::filesystem::remove(folder / "frames-good" / "7_left.png");
  std::ofstream(folder / "frames-good" / "9_left.png") << "not an image";
  EXPECT_EQ(part.run({true, 2}, folder / "part").rows.size(), rendered.rows.size());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pharos::tools::report
