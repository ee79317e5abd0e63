// SPDX-License-Identifier: Apache-2.0
#include "tools/sources/source_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pharos/bearings_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"
#include "tools/listen/received_state.hpp"

namespace pharos::tools {
namespace {

using ::testing::DoubleNear;
using ::testing::Optional;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

pose_t pose_of(std::int64_t sequence, int station = 0) {
  pose_t pose{};
  pose.source = "lighthouse/chaser";
  pose.target = "dock";
  pose.station = static_cast<std::int8_t>(station);
  pose.sequence = sequence;
  pose.status = "ok";
  pose.valid = 1;
  pose.orientation_wxyz[0] = 1.0;
  return pose;
}

void add(SourceTable& table, const pose_t& pose, std::int64_t now_ns = kSecond_ns) {
  table.add("PHAROS_LIGHTHOUSE_POSE", pose, now_ns, now_ns);
}

std::int64_t lost_of(const SourceTable& table) {
  std::int64_t sum = 0;
  for (const auto& [key, row] : table.rows()) sum += row.lost;
  return sum;
}

TEST(SourceTable, TwoStationsOnOneTargetShareTheirNumbersAndNoneIsLost) {
  SourceTable table;
  for (std::int64_t k = 0; k < 20; ++k) add(table, pose_of(k, static_cast<int>(k % 2)));
  EXPECT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(lost_of(table), 0);
  add(table, pose_of(25, 0));
  EXPECT_EQ(lost_of(table), 5);
}

TEST(SourceTable, ValuesThatNoPharosdSendsAreLeftOutAndCounted) {
  SourceTable table;
  std::vector<pose_t> bad(6, pose_of(0));
  bad[0].position_m[1] = std::nan("");
  bad[1].orientation_wxyz[0] = 0.0;
  bad[2].covariance[7] = std::numeric_limits<double>::infinity();
  bad[3].utime = std::numeric_limits<std::int64_t>::min();
  bad[4].sequence = std::numeric_limits<std::int64_t>::max();
  bad[5].target = std::string(100'000, 'x');
  for (const pose_t& pose : bad) add(table, pose);
  EXPECT_TRUE(table.rows().empty());
  EXPECT_EQ(table.left_out().impossible, 6);
}

preview_t preview_of(std::int64_t sequence, const std::string& view = "") {
  preview_t preview{};
  preview.utime = 500'000;
  preview.sequence = sequence;
  preview.source = "ring2/bow";
  preview.station_or_camera = "bow";
  preview.view = view;
  preview.target = "dock";
  preview.status = "ok";
  preview.width_px = 640;
  preview.height_px = 480;
  preview.format = "jpeg";
  preview.data = {0xFF, 0xD8, static_cast<std::uint8_t>(sequence), 0xFF, 0xD9};
  preview.size = static_cast<std::int32_t>(preview.data.size());
  return preview;
}

void add(SourceTable& table, preview_t preview, std::int64_t now_ns = kSecond_ns) {
  table.add("PHAROS_PREVIEW", preview, now_ns, now_ns);
}

TEST(SourceTable, OfEachCameraTheNewestPictureIsKeptAndSaysHowOldItIs) {
  SourceTable table;
  add(table, preview_of(0, "left"));
  add(table, preview_of(0, "right"));
  add(table, preview_of(4, "left"), 2 * kSecond_ns);
  ASSERT_EQ(table.previews().size(), 2u);
  const CameraPreview& left = table.previews()[0];
  EXPECT_EQ(left.view, "left");
  EXPECT_EQ(left.received, 2);
  EXPECT_EQ(left.lost, 3);
  EXPECT_EQ(left.jpeg->at(2), 4);
  EXPECT_NEAR(left.age_s(3 * kSecond_ns), 2.5, 1e-9);
  EXPECT_TRUE(left.current(3 * kSecond_ns));
  EXPECT_FALSE(table.previews()[1].current(3 * kSecond_ns));
  EXPECT_TRUE(table.rows().empty()) << "a picture measures nothing";
}

TEST(SourceTable, WhatIsNoPictureOrTooLargeIsLeftOut) {
  SourceTable table;
  std::vector<preview_t> bad(6, preview_of(0));
  bad[0].format = "png";
  bad[1].data = {'<', 's', 'v', 'g', '>'};
  bad[2].data.clear();
  bad[3].data.insert(bad[3].data.begin() + 2, 32 * 1024, 0);
  bad[4].width_px = 0;
  bad[5].view = std::string(1000, 'x');
  for (const preview_t& preview : bad) add(table, preview);
  EXPECT_EQ(table.left_out().impossible, 6);
  for (int k = 0; k < 100; ++k) add(table, preview_of(0, std::to_string(k)));
  EXPECT_EQ(table.previews().size(), 32u);
  EXPECT_EQ(table.left_out().too_many, 68);
}

TEST(SourceTable, AWholePreviewIsNoForeignMessage) {
  SourceTable table;
  const preview_t preview = preview_of(7);
  std::vector<unsigned char> bytes(static_cast<std::size_t>(preview.getEncodedSize()));
  preview.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  table.take("PHAROS_PREVIEW", bytes.data(), static_cast<int>(bytes.size()), kSecond_ns, kSecond_ns);
  EXPECT_EQ(table.left_out().sum(), 0);
  ASSERT_EQ(table.previews().size(), 1u);
  EXPECT_EQ(*table.previews()[0].jpeg, preview.data);
}

TEST(SourceTable, ForeignBytesUnderAKnownChannelAreCounted) {
  SourceTable table;
  const std::vector<unsigned char> bytes(100, 0xAB);
  table.take("PHAROS_LIGHTHOUSE_POSE", bytes.data(), 100, 0, 0);
  table.take("PHAROS_STATUS", nullptr, 0, 0, 0);
  EXPECT_EQ(table.left_out().foreign, 2);
  EXPECT_EQ(table.received(), 0);
}

bearing_t bearing_of(int sensor, int axis, double theta_rad, bool used) {
  bearing_t bearing{};
  bearing.sensor = static_cast<std::int8_t>(sensor);
  bearing.axis = static_cast<std::int8_t>(axis);
  bearing.ideal_theta_rad = theta_rad;
  bearing.used = used ? 1 : 0;
  return bearing;
}

TEST(SourceTable, ASensorsDirectionIsWhereBothPlanesHitIt) {
  SourceTable table;
  bearings_t bearings{};
  bearings.source = "lighthouse/chaser";
  bearings.target = "dock";
  bearings.calibrated = 1;
  // x/z = cot(theta_x) = 0.5, y/z = -0.25; before it a reflection that was not used.
  bearings.bearings = {bearing_of(7, 0, 1.9, false), bearing_of(7, 0, std::atan2(1.0, 0.5), true),
                       bearing_of(7, 1, std::atan2(1.0, -0.25), true), bearing_of(9, 0, 1.5, false)};
  table.add(bearings, kSecond_ns);
  const Sights* sights = table.sights_of({"PHAROS_LIGHTHOUSE_POSE", "lighthouse/chaser", "dock", 0});
  ASSERT_NE(sights, nullptr);
  ASSERT_TRUE(sights->sensors[7]);
  EXPECT_THAT(sights->sensors[7]->x_over_z, Optional(DoubleNear(0.5, 1e-12)));
  EXPECT_THAT(sights->sensors[7]->y_over_z, Optional(DoubleNear(-0.25, 1e-12)));
  EXPECT_TRUE(sights->sensors[7]->used);
  ASSERT_TRUE(sights->sensors[9]);
  EXPECT_FALSE(sights->sensors[9]->used);
  EXPECT_FALSE(sights->sensors[9]->y_over_z);
  EXPECT_FALSE(sights->sensors[8]);
}

TEST(SourceTable, AxesThatComeInMessagesOfTheirOwnAreJoined) {
  SourceTable table;
  const SourceKey key{"", "", "", 0};
  bearings_t x{}, y{};
  x.bearings = {bearing_of(7, 0, std::atan2(1.0, 0.5), true)};
  y.bearings = {bearing_of(7, 1, std::atan2(1.0, -0.25), true)};
  table.add(x, kSecond_ns);
  table.add(y, kSecond_ns + 8'000'000);
  ASSERT_TRUE(table.sights_of(key)->sensors[7]);
  EXPECT_THAT(table.sights_of(key)->sensors[7]->x_over_z, Optional(DoubleNear(0.5, 1e-12)));
  EXPECT_THAT(table.sights_of(key)->sensors[7]->y_over_z, Optional(DoubleNear(-0.25, 1e-12)));
  table.add(y, 2 * kSecond_ns);
  EXPECT_FALSE(table.sights_of(key)->sensors[7]->x_over_z) << "too old";
}

TEST(SourceTable, ABearingOfASensorThatCannotBeIsLeftOut) {
  SourceTable table;
  bearings_t bearings{};
  bearings.bearings = {bearing_of(32, 0, 1.5, true)};
  table.add(bearings, kSecond_ns);
  bearings.bearings = {bearing_of(3, 0, 0.0, true)};
  table.add(bearings, kSecond_ns);
  EXPECT_EQ(table.left_out().impossible, 2);
}

TEST(SourceTable, ItsSizeIsBoundedWhateverComes) {
  SourceTable table;
  for (int k = 0; k < 1000; ++k) {
    pose_t pose = pose_of(0);
    pose.target = "t" + std::to_string(k);
    add(table, pose);
    bearings_t bearings{};
    bearings.target = pose.target;
    table.add(bearings, kSecond_ns);
    status_t status{};
    status.host = pose.target;
    table.add(status, kSecond_ns);
    status.state = "error" + std::to_string(k);
    table.add(status, kSecond_ns);
  }
  EXPECT_EQ(table.rows().size(), 128u);
  EXPECT_LE(table.daemons().size(), 16u);
  EXPECT_LE(table.events().size(), 50u);
  EXPECT_GT(table.left_out().too_many, 0);
}

TEST(SourceTable, EventsAreNumberedSoThatAReaderSeesEachOnce) {
  SourceTable table;
  status_t status{};
  status.host = "chaser";
  for (int k = 0; k < 100; ++k) {
    status.state = k % 2 == 0 ? "ok" : "error";
    table.add(status, kSecond_ns);
  }
  ASSERT_FALSE(table.events().empty());
  EXPECT_EQ(table.events().back().number, 99);
  EXPECT_EQ(table.events().front().number, 50);
}

TEST(SourceTable, ASpinIsARow) {
  SourceTable table;
  spin_t spin{};
  spin.source = "slam/bow";
  spin.status = "ok";
  spin.valid = 1;
  spin.rate_rad_s[2] = 0.1;
  table.add("PHAROS_SLAM_SPIN", spin, kSecond_ns, kSecond_ns);
  ASSERT_EQ(table.rows().size(), 1u);
  EXPECT_DOUBLE_EQ(table.rows().begin()->second.spin->rate_rad_s.z(), 0.1);
}

TEST(SourceTableOfStates, AFusedStateHasARowWithItsSources) {
  target_state_t state{};
  state.utime = 1'000'000;
  state.target = "client";
  state.mode = "fused";
  state.valid = 1;
  state.orientation_wxyz[0] = 1.0;
  state.position_m[2] = 2.0;
  for (int i = 0; i < 12; ++i) state.covariance[13 * i] = 1e-6;
  state.position_protection_available = 1;
  state.position_protection_m = 0.02;
  state.sources.resize(2);
  state.sources[0].name = "lighthouse";
  state.sources[0].state = "used";
  state.sources[1].name = "tof";
  state.sources[1].state = "excluded";
  state.sources[1].reason = "step";
  state.source_count = 2;
  constexpr std::int64_t kNow_ns = 1'000'000'000;
  SourceTable table;
  table.add("PHAROS_TARGET_STATE", state, kNow_ns, kNow_ns);
  ASSERT_EQ(table.rows().size(), 1U);
  const SourceRow& row = table.rows().begin()->second;
  EXPECT_EQ(row.status, "fused");
  EXPECT_EQ(row.flags, "tof:excluded:step");
  ASSERT_TRUE(row.fused && row.pose);
  EXPECT_EQ(row.pose->pose->t.z(), 2.0);
  EXPECT_NEAR(row.pose->sigma_pos_m, std::sqrt(3e-6), 1e-12);
  EXPECT_EQ(row.fused->protection_m, 0.02);
  EXPECT_FALSE(row.fused->protection_rad.has_value());
  EXPECT_EQ(fused_text(*row.fused), "protected to 20.0 mm - deg  lighthouse used, tof excluded (step)");
  state.mode = "lost";
  state.valid = 0;
  table.add("PHAROS_TARGET_STATE", state, kNow_ns + 1, kNow_ns + 1);
  EXPECT_EQ(table.rows().begin()->second.status, "lost");
  EXPECT_EQ(table.events().back().text.find("client fused state: lost") != std::string::npos, true);
  state.valid = 1;
  state.covariance[0] = std::nan("");
  table.add("PHAROS_TARGET_STATE", state, kNow_ns + 2, kNow_ns + 2);
  EXPECT_EQ(table.left_out().impossible, 1);
}

}  // namespace
}  // namespace pharos::tools
