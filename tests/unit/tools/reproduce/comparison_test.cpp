// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/comparison/comparison.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace pharos::tools {
namespace {

TEST(Comparison, HasARatioOnlyWhereANumberIsPublished) {
  EXPECT_EQ(ratio_of({"", "", "", "0.5", 1.0, ""}), 2.0);
  EXPECT_EQ(ratio_of({"", "", "", "<= 9.2", 1.0, ""}), std::nullopt);
  EXPECT_EQ(ratio_of({"", "", "", "", 1.0, ""}), std::nullopt);
  EXPECT_EQ(ratio_of({"", "", "", "0", 1.0, ""}), std::nullopt);
}

TEST(Comparison, IsRoundedForPeopleOnly) {
  const std::vector<ComparisonRow> rows = {{"table 2", "run 1", "deg", "0.5", 1.23456, "note"},
                                           {"counts", "frames", "", "", 179918.0, ""}};
  const std::string path = ::testing::TempDir() + "pharos_comparison.md";
  write_markdown(rows, path);
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text,
            "| item | what | published or asked | ours | ratio | remark |\n|---|---|---|---|---|---|\n"
            "| table 2 | run 1 | 0.5 deg | 1.23 deg | 2.47 | note |\n| counts | frames |  | 179918 |  |  |\n");
  write_rows(rows, {false, path});
  std::ifstream csv(path);
  const std::string exact{std::istreambuf_iterator<char>(csv), {}};
  EXPECT_NE(exact.find("table 2,run 1,deg,0.5,1.23456,2.46912,note\n"), std::string::npos) << exact;
  std::remove(path.c_str());
}

}  // namespace
}  // namespace pharos::tools
