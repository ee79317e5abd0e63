// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "host/publish/messages.hpp"

namespace pharos::host {
namespace {

SourceHealth source(const std::string& target, SourceState state, const std::string& message = "") {
  SourceHealth health;
  health.target = target;
  health.state = state;
  health.message = message;
  return health;
}

TEST(StatusMessage, IsOkOnlyWhenEverySourceIs) {
  DaemonHealth health;
  health.sources = {source("a", SourceState::kOk), source("b", SourceState::kOk)};
  EXPECT_EQ(status_message(health, 0).state, "ok");
  health.sources[1] = source("b", SourceState::kStale, "no data for 3 s");
  EXPECT_EQ(status_message(health, 0).state, "degraded");
  EXPECT_EQ(status_message(health, 0).message, "b: no data for 3 s");
}

TEST(StatusMessage, IsAnErrorWhenNoSourceCanDeliver) {
  DaemonHealth health;
  health.sources = {source("a", SourceState::kGone, "unplugged"), source("b", SourceState::kError, "busy")};
  EXPECT_EQ(status_message(health, 0).state, "error");
}

TEST(StatusMessage, TheDaemonsOwnErrorComesFirst) {
  DaemonHealth health;
  health.message = "recording stopped: disk full";
  health.sources = {source("a", SourceState::kOk)};
  const status_t message = status_message(health, 5);
  EXPECT_EQ(message.state, "degraded");
  EXPECT_EQ(message.message, "recording stopped: disk full");
  EXPECT_EQ(message.sequence, 5);
}

TEST(StatusMessage, CarriesEveryCounterAndNeverConfusesNeverWithNow) {
  DaemonHealth health;
  SourceHealth dock = source("dock", SourceState::kWaiting);
  dock.counters = {{"link.frames", 7}, {"link.bad_crc", 2}};
  dock.data_age_ns = 0;
  dock.pose_age_ns = -1;
  health.sources = {dock};
  const status_t message = status_message(health, 0);
  ASSERT_EQ(message.source_count, 1);
  ASSERT_EQ(message.sources[0].counter_count, 2);
  EXPECT_EQ(message.sources[0].counters[1].name, "link.bad_crc");
  EXPECT_EQ(message.sources[0].counters[1].value, 2);
  EXPECT_EQ(message.sources[0].data_age_us, 0);
  EXPECT_EQ(message.sources[0].pose_age_us, -1);
}

}  // namespace
}  // namespace pharos::host
