// SPDX-License-Identifier: Apache-2.0
#include "host/config/live_changes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/host/config/made_up.hpp"

namespace pharos::host {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr const char* kDock = "[[target]]\nname = 'dock'\nport = '/dev/a'\ntarget_file = 'dock.csv'\n";
constexpr const char* kQuay = "[[target]]\nname = 'quay'\nport = '/dev/b'\ntarget_file = 'quay.csv'\n";

TEST(LiveChanges, TakesTheLogLevelAndThePublishLimits) {
  DaemonConfig config = parse(kDock);
  const DaemonConfig fresh =
      parse(std::string("log.level = 'debug'\n[publish]\nmax_age_s = 1.5\nstatus_rate_hz = 5\n") + kDock);
  EXPECT_THAT(take_live_changes(fresh, config), IsEmpty());
  EXPECT_EQ(config.log.level, "debug");
  EXPECT_EQ(config.publish.max_age_s, 1.5);
  EXPECT_EQ(config.publish.status_period_s, 0.2);
}

TEST(LiveChanges, TakesTheCalibrationOfATargetOfTheSameName) {
  DaemonConfig config = parse(kDock);
  DaemonConfig fresh = config;
  EXPECT_TRUE(same_calibration(fresh.targets[0], config.targets[0]));
  fresh.targets[0].calibration_file = "/etc/pharos/new.toml";
  fresh.targets[0].scale_sigma = 0.002;
  fresh.targets[0].calibrated_stations.push_back({7u, std::nullopt, {}});
  EXPECT_FALSE(same_calibration(fresh.targets[0], config.targets[0]));
  EXPECT_THAT(take_live_changes(fresh, config), IsEmpty());
  EXPECT_TRUE(same_calibration(fresh.targets[0], config.targets[0]));
}

TEST(LiveChanges, NamesWhatNeedsARestart) {
  DaemonConfig config = parse(kDock);
  const DaemonConfig fresh = parse(std::string("source = 'other'\n") + kDock + "baud = 9600\n");
  EXPECT_THAT(take_live_changes(fresh, config), ElementsAre("source: other", "target dock: port: /dev/a at 9600 baud"));
  EXPECT_EQ(config.source, "pharosd");
  EXPECT_EQ(config.targets[0].baud, 460'800);
}

TEST(LiveChanges, NamesSourcesThatCameAndThatWent) {
  DaemonConfig config = parse(std::string(kDock) + kQuay);
  EXPECT_THAT(take_live_changes(parse(kDock), config), UnorderedElementsAre("without target quay:"));
  EXPECT_EQ(config.targets.size(), 2u);
  DaemonConfig one = parse(kDock);
  EXPECT_THAT(take_live_changes(config, one), ::testing::Contains("target quay:"));
}

}  // namespace
}  // namespace pharos::host
