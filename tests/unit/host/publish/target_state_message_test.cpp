// SPDX-License-Identifier: Apache-2.0
#include "host/publish/target_state_message.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pharos::host {
namespace {

fusion::TargetState fused() {
  fusion::TargetState state;
  state.mode = fusion::Mode::kFused;
  state.valid = true;
  state.kinematics.pose = {rotation_exp(Vector3(0.1, 0.2, 0.3)), {1.0, 2.0, 3.0}};
  state.kinematics.velocity_m_s = Vector3(0.1, 0.2, 0.3);
  state.kinematics.rate_rad_s = Vector3(0.4, 0.5, 0.6);
  for (int i = 0; i < 12; ++i) state.covariance(i, i) = i + 1.0;
  state.covariance(0, 11) = 0.5;
  state.protection = {true, false, 0.02, 0.0};
  fusion::SourceReport used;
  used.state = fusion::SourceState::kUsed;
  used.heard = true;
  used.age_s = 0.25;
  state.sources.push_back(used);
  fusion::SourceReport excluded;
  excluded.state = fusion::SourceState::kExcluded;
  excluded.reason = fusion::FaultKind::kFreeze;
  state.sources.push_back(excluded);
  return state;
}

const TargetStateHeader kHeader{1'500'000'000'123'456'000, 7, "chaser", {"tof", "ring2"}, 1e-5};

TEST(TargetStateMessage, HasTheState) {
  const target_state_t message = message_of(fused(), kHeader);
  EXPECT_EQ(message.utime, 1'500'000'000'123'456);
  EXPECT_EQ(message.sequence, 7);
  EXPECT_EQ(message.mode, "fused");
  EXPECT_EQ(message.valid, 1);
  EXPECT_EQ(message.position_m[2], 3.0);
  EXPECT_EQ(message.velocity_m_s[1], 0.2);
  EXPECT_EQ(message.angular_rate_rad_s[0], 0.4);
  EXPECT_EQ(message.covariance[11], 0.5);
  EXPECT_EQ(message.covariance[143], 12.0);
  EXPECT_EQ(message.position_protection_available, 1);
  EXPECT_EQ(message.rotation_protection_available, 0);
  EXPECT_EQ(message.position_protection_m, 0.02);
}

TEST(TargetStateMessage, HasTheSources) {
  const target_state_t message = message_of(fused(), kHeader);
  ASSERT_EQ(message.source_count, 2);
  EXPECT_EQ(message.sources[0].name, "tof");
  EXPECT_EQ(message.sources[0].state, "used");
  EXPECT_EQ(message.sources[0].age_us, 250'000);
  EXPECT_EQ(message.sources[1].state, "excluded");
  EXPECT_EQ(message.sources[1].reason, "freeze");
  EXPECT_EQ(message.sources[1].age_us, -1);
}

TEST(TargetStateMessage, SurvivesTheNetwork) {
  const target_state_t sent = message_of(fused(), kHeader);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(sent.getEncodedSize()));
  ASSERT_EQ(sent.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  target_state_t received{};
  ASSERT_EQ(received.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  EXPECT_EQ(received.mode, sent.mode);
  EXPECT_EQ(received.sources[1].reason, "freeze");
  EXPECT_EQ(received.covariance[11], 0.5);
}

TEST(TargetStateMessage, TellsBothSidesOfAConflict) {
  fusion::TargetState state = fused();
  state.mode = fusion::Mode::kConflict;
  state.conflict[0] = {0, true, state.kinematics.pose, Matrix6::Identity()};
  state.conflict[1] = {1, true, state.kinematics.pose, Matrix6::Identity()};
  const target_state_t message = message_of(state, kHeader);
  EXPECT_EQ(message.has_conflict, 1);
  EXPECT_EQ(message.conflict_without[1], "ring2");
  EXPECT_EQ(message.conflict_position_m[1][0], 1.0);
}

TEST(TargetStateMessage, WhatIsNotFiniteIsNotValid) {
  fusion::TargetState state = fused();
  state.kinematics.pose.t.x() = std::numeric_limits<double>::quiet_NaN();
  const target_state_t message = message_of(state, kHeader);
  EXPECT_EQ(message.valid, 0);
  EXPECT_EQ(message.position_m[0], 0.0);
}

}  // namespace
}  // namespace pharos::host
