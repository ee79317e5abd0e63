// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/config/live_changes.hpp"
#include "host/config/source_table.hpp"
#include "tests/unit/host/config/made_up.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Line 1 to 6.
constexpr const char* kRemote =
    "[[remote]]\nname = 'bow'\nchannel = 'CAM_TOF_POSE'\nsource = 'tof/helios'\ntarget = 'client'\n"
    "daemon = 'cameras'\n";

std::string with(const std::string& old, const std::string& fresh) {
  std::string text = kRemote;
  text.replace(text.find(old), old.size(), fresh);
  return text;
}

TEST(RemoteConfig, HasItsKeysAndDefaults) {
  const DaemonConfig config = parse(kRemote);
  ASSERT_EQ(config.remotes.size(), 1U) << "a remote alone is enough for a daemon";
  const RemoteConfig& remote = config.remotes[0];
  EXPECT_EQ(remote.name, "bow");
  EXPECT_EQ(remote.channel, "CAM_TOF_POSE");
  EXPECT_EQ(remote.kind, SourceKind::kTof);
  EXPECT_EQ(remote.frame, "camera");
  EXPECT_EQ(remote.feature, "target");
  EXPECT_EQ(remote.daemon, "cameras");
  EXPECT_FALSE(remote.clock_sigma_s.has_value());
  EXPECT_EQ(remote.rate_hz, 0.0);
  EXPECT_EQ(remote.max_age_s, 0.5);
  EXPECT_EQ(remote.silent_after_s, 1.0);
  EXPECT_THAT(describe(config), AllOf(HasSubstr("remote bow (target client)"), HasSubstr("compared with cameras's")));
  EXPECT_THAT(source_table(config), Contains(AllOf(StartsWith("remote/bow"), HasSubstr("CAM_TOF_POSE"))));
  const RemoteConfig held = parse(with("daemon = 'cameras'", "clock_sigma_ms = 0.1\nrate_hz = 10")).remotes[0];
  EXPECT_EQ(held.clock_sigma_s, 1e-4);
  EXPECT_EQ(held.rate_hz, 10.0);
}

TEST(RemoteConfig, FramesAreThoseOfTheKind) {
  EXPECT_EQ(parse(with("tof/helios", "ring2/r")).remotes[0].frame, "rig");
  const RemoteConfig lighthouse = parse(with("tof/helios", "lighthouse/cameras")).remotes[0];
  EXPECT_EQ(lighthouse.frame, "lighthouse");
  EXPECT_EQ(lighthouse.feature, "body");
  EXPECT_EQ(parse(with("tof/helios'", "lighthouse/cameras'\nframe = 'world'")).remotes[0].frame, "world");
  EXPECT_THAT(error_of(std::string(kRemote) + "frame = 'world'\n"), HasSubstr("p.toml:7: remote[0].frame"));
}

TEST(RemoteConfig, ErrorsHaveTheirLine) {
  EXPECT_THAT(error_of(with("name = 'bow'", "name = 'b w'")), HasSubstr("p.toml:2: remote[0].name"));
  EXPECT_THAT(error_of(with("CAM_TOF_POSE", ".*")), HasSubstr("p.toml:3: remote[0].channel"));
  EXPECT_THAT(error_of(with("CAM_TOF_POSE", std::string(64, 'A'))), HasSubstr("p.toml:3: remote[0].channel"));
  EXPECT_THAT(error_of(with("tof/helios", "sonar/helios")), HasSubstr("p.toml:4: remote[0].source"));
  EXPECT_THAT(error_of(with("tof/helios", "tof")), HasSubstr("p.toml:4: remote[0].source"));
  EXPECT_THAT(error_of(with("tof/helios", "line/dish")), HasSubstr("p.toml:4: remote[0].source"));
  EXPECT_THAT(error_of(with("daemon = 'cameras'", "")),
              AllOf(HasSubstr("remote[0].daemon"), HasSubstr("clock_sigma_ms")));
  EXPECT_THAT(error_of(std::string(kRemote) + "clock_sigma_ms = 1\n"), HasSubstr("exclude each other"));
  EXPECT_THAT(error_of(with("cameras", "pharosd")), HasSubstr("this daemon's own name"));
  EXPECT_THAT(error_of(std::string(kRemote) + "max_age_s = 60\n"), HasSubstr("p.toml:7: remote[0].max_age_s"));
  EXPECT_THAT(error_of(std::string(kRemote) + "silent_after_s = 0\n"), HasSubstr("remote[0].silent_after_s"));
  EXPECT_THAT(error_of(std::string(kRemote) + "rate_hz = -1\n"), HasSubstr("remote[0].rate_hz"));
  EXPECT_THAT(error_of(std::string(kRemote) + "rate = 1\n"), HasSubstr("p.toml:7: remote[0].rate: unknown key"));
  EXPECT_THAT(error_of("[lcm]\nurl = 'file:///tmp/x.lcm?mode=w'\n" + std::string(kRemote)),
              HasSubstr("lcm.url writes a file"));
  EXPECT_THAT(error_of("[lcm]\nclock_channel = ''\n" + std::string(kRemote)), HasSubstr("lcm.clock_channel"));
}

TEST(RemoteConfig, EveryStreamIsTakenOnce) {
  EXPECT_THAT(error_of(std::string(kRemote) + kRemote),
              AllOf(HasSubstr("\"bow\" is taken by another remote"), HasSubstr("on this channel is taken")));
  const std::string camera = "[[camera]]\nname = 'helios'\ntarget = 'client'\ncamera_file = 'h.toml'\nserial = '1'\n";
  EXPECT_THAT(error_of(camera + with("CAM_TOF_POSE", "PHAROS_TOF_POSE")), HasSubstr("a source of this daemon itself"));
  EXPECT_THAT(error_of(camera + kRemote), IsEmpty()) << "of another prefix";
}

TEST(RemoteConfig, IsASourceOfTheVehicle) {
  const std::string text = std::string(kRemote) + "[vehicle]\nmounting_file = 'm.toml'\n";
  const DaemonConfig config = parse(text);  // its mounting has tof
  ASSERT_EQ(config.vehicle->sources.size(), 1U);
  EXPECT_EQ(config.vehicle->sources[0].source, "remote/bow");
  EXPECT_TRUE(config.vehicle->sources[0].is_remote);
  EXPECT_EQ(config.vehicle->target, "client");
}

TEST(RemoteConfig, AChangeNeedsARestart) {
  DaemonConfig config = parse(kRemote);
  EXPECT_THAT(take_live_changes(parse(with("CAM_TOF_POSE", "OTHER_TOF_POSE")), config),
              Contains(HasSubstr("OTHER_TOF_POSE")));
}

}  // namespace
}  // namespace pharos::host
