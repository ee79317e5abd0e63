// SPDX-License-Identifier: Apache-2.0
#include "tools/view/lights.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/bearings_t.hpp"
#include "pharos/status_t.hpp"
#include "some_messages.hpp"

namespace pharos::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Property;

using test::kSecond_ns;

Lights lights_after(const SourceTable& table, std::int64_t now_ns = kSecond_ns) {
  const auto& [key, row] = *table.rows().begin();
  return lights_of(table, key, row, now_ns);
}

Lights lights_of_pose(const pose_t& pose) {
  SourceTable table;
  table.add("PHAROS_LIGHTHOUSE_POSE", pose, kSecond_ns, kSecond_ns);
  return lights_after(table);
}

TEST(Lights, AGoodPoseTurnsAllGreen) {
  const Lights lights = lights_of_pose(test::some_pose());
  EXPECT_EQ(lights.sees_light.level, LightLevel::kGood);
  EXPECT_EQ(lights.calibrated.level, LightLevel::kGood);
  EXPECT_EQ(lights.geometry_known.level, LightLevel::kGood);
  EXPECT_EQ(lights.estimate_good.level, LightLevel::kGood);
  EXPECT_THAT(lights.estimate_good.reason, HasSubstr("sigma 1.00 mm"));
}

TEST(Lights, EachFlagDimsItsLightWithAReason) {
  pose_t pose = test::some_pose();
  pose.flags = "prior|uncalibrated";
  EXPECT_EQ(lights_of_pose(pose).calibrated.level, LightLevel::kDegraded);
  pose.flags = "no_connector";
  EXPECT_THAT(lights_of_pose(pose).geometry_known.reason, HasSubstr("turn"));
  pose.flags = "residual_high";
  EXPECT_EQ(lights_of_pose(pose).estimate_good.level, LightLevel::kDegraded);
  EXPECT_EQ(lights_of_pose(pose).estimate_good.reason, "residual_high");
  pose.flags = "prior";
  EXPECT_EQ(lights_of_pose(pose).estimate_good.level, LightLevel::kGood) << "no warning";
  pose.flags = "";
  pose.status = "ambiguous";
  EXPECT_EQ(lights_of_pose(pose).geometry_known.level, LightLevel::kDegraded);
}

TEST(Lights, ARefusalBeforeAnyPoseIsBadWithItsReason) {
  pose_t pose = test::some_pose();
  pose.valid = 0;
  pose.status = "refused_too_few_sensors";
  const Lights lights = lights_of_pose(pose);
  EXPECT_EQ(lights.sees_light.level, LightLevel::kGood) << "it sees light";
  EXPECT_EQ(lights.estimate_good.level, LightLevel::kBad);
  EXPECT_EQ(lights.estimate_good.reason, "refused: too few sensors");
}

TEST(Lights, ASourceThatStopsTurnsRedWithWhatItsDaemonSays) {
  SourceTable table;
  table.add("PHAROS_LIGHTHOUSE_POSE", test::some_pose(), kSecond_ns, kSecond_ns);
  status_t status{};
  status.host = "chaser";
  source_status_t source{};
  source.source = "lighthouse/chaser";
  source.target = "dock";
  source.state = "gone";
  source.message = "unplugged: check the cable";
  status.sources = {source};
  table.add(status, 4 * kSecond_ns);
  const Lights lights = lights_after(table, 4 * kSecond_ns);
  EXPECT_EQ(lights.sees_light.level, LightLevel::kBad);
  EXPECT_EQ(lights.sees_light.reason, "no message for 3.0 s; gone: unplugged: check the cable");
  EXPECT_EQ(lights.estimate_good.level, LightLevel::kBad);
  EXPECT_THAT(lights.estimate_good.reason, HasSubstr("LOST"));
}

TEST(Lights, AnglesWithoutCalibrationAreTold) {
  SourceTable table;
  table.add("PHAROS_LIGHTHOUSE_POSE", test::some_pose(), kSecond_ns, kSecond_ns);
  bearings_t bearings{};
  bearings.source = "lighthouse/chaser";
  bearings.target = "dock";
  table.add(bearings, kSecond_ns);
  EXPECT_EQ(lights_after(table).calibrated.level, LightLevel::kDegraded);
}

}  // namespace
}  // namespace pharos::tools
