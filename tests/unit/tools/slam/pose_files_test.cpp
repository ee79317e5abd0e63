// SPDX-License-Identifier: Apache-2.0
#include "tools/slam/pose_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/evaluate/trajectory_file.hpp"

namespace pharos::tools {
namespace {

// Three frames with poses, and a lost one before the last.
std::vector<slam::TrackedFrame> trajectory() {
  std::mt19937_64 random(31);
  std::normal_distribution<double> normal;
  std::vector<slam::TrackedFrame> frames(4);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].time_s = 1'700'000'000.0 + 0.05 * static_cast<double>(k);
    if (k == 2) continue;
    slam::TrackedPose placed;
    placed.pose = {rotation_exp(Vector3(normal(random), normal(random), normal(random))),
                   Vector3(normal(random), normal(random), normal(random))};
    const Matrix6 factor = Matrix6::NullaryExpr([&] { return 1e-3 * normal(random); });
    placed.covariance = factor * factor.transpose();
    frames[k].placed = placed;
  }
  return frames;
}

class SlamPoseFiles : public ::testing::TestWithParam<bool> {
 protected:
  PoseFile file(const std::string& format, bool covariance) const {
    PoseFile file{{}, GetParam()};
    file.output.path = folder_.path("poses." + format);
    file.output.format = format;
    file.output.covariance = covariance;
    return file;
  }
  test::TemporaryFolder folder_;
};

TEST_P(SlamPoseFiles, TheCovarianceReadBackIsThatOfTheWrittenPoseAndItsSigmas) {
  const auto frames = trajectory();
  EXPECT_EQ(write_poses(file("csv", true), frames), 3);
  std::vector<std::string> columns = host::covariance_columns();
  columns.insert(columns.end(), {"sigma_rot_deg", "sigma_pos_mm", "status"});
  host::TableReader table(host::ByteSource(folder_.path("poses.csv")), columns);
  for (const slam::TrackedFrame& frame : frames) {
    ASSERT_TRUE(table.next());
    if (!frame.placed) {
      EXPECT_EQ(table.text(38), "refused_lost");
      EXPECT_TRUE(table.empty(0));
      continue;
    }
    Matrix6 read;
    for (std::size_t k = 0; k < 36; ++k) read(static_cast<int>(k / 6), static_cast<int>(k % 6)) = table.number(k);
    const Matrix6 written = GetParam() ? inverse_of(*frame.placed).covariance : frame.placed->covariance;
    EXPECT_EQ((read - written).norm(), 0.0);
    EXPECT_DOUBLE_EQ(std::sqrt(read.topLeftCorner<3, 3>().trace()) * kDegPerRad, table.number(36));
    EXPECT_DOUBLE_EQ(std::sqrt(read.bottomRightCorner<3, 3>().trace()) * kMmPerM, table.number(37));
  }
}

TEST_P(SlamPoseFiles, TumIsReadByEvaluateAsTheSamePoses) {
  const auto frames = trajectory();
  EXPECT_EQ(write_poses(file("tum", false), frames), 3);
  const auto read = evaluate::read_trajectory<evaluate::EstimatePose>(folder_.path("poses.tum"), {}).samples;
  ASSERT_EQ(read.size(), 3U);
  std::size_t next = 0;
  for (const slam::TrackedFrame& frame : frames) {
    if (!frame.placed) continue;
    EXPECT_EQ(read[next].time_s, frame.time_s);
    const auto pose = GetParam() ? frame.placed->pose.inverse().t : frame.placed->pose.t;
    EXPECT_EQ((read[next].pose.t - pose).norm(), 0.0);
    const Matrix3 R = GetParam() ? Matrix3(frame.placed->pose.R.transpose()) : frame.placed->pose.R;
    EXPECT_LT((read[next].pose.R - R).norm(), 1e-12);
    ++next;
  }
}

INSTANTIATE_TEST_SUITE_P(OfTargetAndCamera, SlamPoseFiles, ::testing::Bool());

}  // namespace
}  // namespace pharos::tools
