// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tools/evaluation/report/exhibits.hpp"
#include "tools/evaluation/reproduce/pointing/attitude_tables.hpp"

namespace pharos::tools::report {
namespace {

TEST(LinePart, HasEveryTableAndFigureOfPaperThree) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "paper_three";
  std::filesystem::create_directories(folder);
  const PartResult result = line_part().run({true, 1}, folder);
  for (const Exhibit& one : exhibits()) {
    if (one.paper != "003") continue;
    EXPECT_TRUE(missing_of(one, one.parts.empty() ? PartResult{} : result).empty()) << one.label;
  }
  for (const ComparisonRow& row : result.rows) EXPECT_FALSE(ratio_of(row).has_value()) << row.what;
}

}  // namespace
}  // namespace pharos::tools::report
