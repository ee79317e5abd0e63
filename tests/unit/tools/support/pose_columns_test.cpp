// SPDX-License-Identifier: Apache-2.0
#include "tools/support/pose_columns.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pharos::tools {
namespace {

std::string second_solution_row(const LighthousePoseEstimate* estimate) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    host::RowWriter rows(stream, host::RowFormat::kCsv, second_solution_columns());
    write_second_solution(rows, estimate);
    rows.end_row();
  }
  std::fclose(stream);
  std::string out(text, size);
  std::free(text);
  return out.substr(out.find('\n') + 1);
}

TEST(PoseColumns, StandBetweenWhatComesBeforeAndAfter) {
  const std::vector<std::string> expected = {"time_s", "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m", "status"};
  EXPECT_EQ(with_pose_columns({"time_s"}, {"status"}), expected);
}

TEST(PoseColumns, FillTheSecondSolutionExactlyWhenAmbiguous) {
  LighthousePoseEstimate estimate;
  EXPECT_EQ(second_solution_row(&estimate), ",,,,,,,\n");
  EXPECT_EQ(second_solution_row(nullptr), ",,,,,,,\n");
  estimate.second.emplace();
  estimate.second->pose.t = {1.0, 2.0, 3.5};
  estimate.second->delta_chi2 = 0.25;
  EXPECT_EQ(second_solution_row(&estimate), "1,0,0,0,1,2,3.5,0.25\n");
}

TEST(StatusOf, SaysOkAmbiguousOrWhyRefused) {
  LighthousePoseEstimate estimate;
  EXPECT_EQ(status_of(estimate), "ok");
  estimate.second.emplace();
  EXPECT_EQ(status_of(estimate), "ambiguous");
  EXPECT_EQ(status_of(pose::Refusal::kTooFewSensors), "refused_too_few_sensors");
}

}  // namespace
}  // namespace pharos::tools
