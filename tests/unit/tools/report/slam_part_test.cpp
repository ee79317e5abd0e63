// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tools/evaluation/report/exhibits.hpp"
#include "tools/evaluation/reproduce/slam/slam_parts.hpp"

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

}  // namespace
}  // namespace pharos::tools::report
