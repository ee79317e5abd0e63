// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>

#include "host/config/live_changes.hpp"
#include "host/config/source_table.hpp"
#include "tests/unit/host/config/made_up.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr const char* kSources =
    "[[target]]\nname = 'client'\nport = '/dev/a'\ntarget_file = 't.csv'\n"
    "[[camera]]\nname = 'Helios'\ntarget = 'client'\ncamera_file = 'h.toml'\nserial = '1'\n"
    "[[stereo]]\nname = 'bow'\ntarget = 'client'\nrig_file = 'r.toml'\nsystems = ['ring2', 'slam']\n"
    "left.serial = '2'\nright.serial = '3'\n";
constexpr const char* kVehicle = "[vehicle]\nmounting_file = 'm.toml'\n";

SourceMounting mounting_of(const std::string& name) {
  SourceMounting mounting;
  mounting.name = name;
  for (const char* kind : {"lighthouse", "tof", "ring2", "slam"}) {
    if (name.find(kind) != std::string::npos) mounting.kind = *source_kind(kind);
  }
  if (name == "helios") mounting.kind = SourceKind::kTof;
  mounting.T_vehicle_sensor.origin = MountingOrigin::kGiven;
  if (mounting.kind != SourceKind::kSlam) {
    mounting.T_target_feature.emplace();
    mounting.T_target_feature->origin = MountingOrigin::kGiven;
  }
  return mounting;
}

DaemonConfig parse_with(const std::vector<std::string>& mounted, const std::string& text) {
  Environment environment = made_up();
  environment.read_mounting = [mounted](const std::string& path) {
    if (path.find("gone") != std::string::npos) throw InputError(path + ": cannot be opened");
    Mounting mounting;
    for (const std::string& name : mounted) mounting.sources.push_back(mounting_of(name));
    return mounting;
  };
  return parse_daemon_config(text, "p.toml", "/etc/pharos", environment);
}
std::string error_with(const std::vector<std::string>& mounted, const std::string& text) {
  return pharos::test::error_of([&] { parse_with(mounted, text); });
}
std::vector<std::string> bound(const DaemonConfig& config) {
  std::vector<std::string> out;
  for (const FusedSourceConfig& source : config.vehicle->sources) {
    out.push_back(source.mounting.name + "=" + source.source + source.station);
  }
  return out;
}

TEST(VehicleConfig, SourcesOfTheMountingFileAreThoseThatTheyAreNamedAfter) {
  const std::string text = std::string(kSources) + kVehicle;
  const DaemonConfig config = parse_with({"lighthouse", "tof", "ring2", "slam"}, text);
  EXPECT_THAT(bound(config),
              ElementsAre("lighthouse=lighthouse", "tof=tof/Helios", "ring2=ring2/bow", "slam=slam/bow"));
  EXPECT_EQ(config.vehicle->target, "client");
  EXPECT_EQ(config.vehicle->rate_hz, 20.0);
  EXPECT_EQ(config.vehicle->mounting_file, "/etc/pharos/m.toml");
  EXPECT_THAT(bound(parse_with({"helios", "ring2-bow"}, text)),
              ElementsAre("helios=tof/Helios", "ring2-bow=ring2/bow"));
  EXPECT_FALSE(parse(kSources).vehicle.has_value());
}

TEST(VehicleConfig, WhatIsMissingOnEitherSideIsTold) {
  const DaemonConfig config = parse_with({"lighthouse", "tof-stern"}, std::string(kSources) + kVehicle);
  EXPECT_THAT(bound(config), ElementsAre("lighthouse=lighthouse"));
  EXPECT_THAT(describe(config), AllOf(HasSubstr("not configured here: tof-stern"),
                                      HasSubstr("not fused, as it has no mounting: tof Helios")));
  EXPECT_THAT(source_table(config), Contains(AllOf(StartsWith("fusion/pharosd"), HasSubstr("PHAROS_TARGET_STATE"))));
}

TEST(VehicleConfig, ErrorsHaveTheirLine) {
  const std::string sources = kSources;
  EXPECT_THAT(error_with({"tof"}, sources + "[vehicle]\nmounting_file = 'gone.toml'\n"),
              AllOf(HasSubstr("p.toml:18: vehicle.mounting_file"), HasSubstr("gone.toml: cannot be opened")));
  EXPECT_THAT(error_with({"tof"}, sources + kVehicle + "rate_hz = 0\n"), HasSubstr("p.toml:19: vehicle.rate_hz"));
  EXPECT_THAT(error_with({"tof"}, sources + kVehicle + "motion = 'ballistic'\n"),
              HasSubstr("p.toml:19: vehicle.motion"));
  EXPECT_THAT(error_with({"tof"}, sources + kVehicle + "rate = 1\n"),
              HasSubstr("p.toml:19: vehicle.rate: unknown key"));
  EXPECT_THAT(error_with({"tof"}, sources + kVehicle + "sources = ['tof', 'sonar']\n"),
              AllOf(HasSubstr("p.toml:19: vehicle.sources"), HasSubstr("sonar")));
  EXPECT_THAT(error_with({"tof-stern"}, sources + kVehicle),
              AllOf(HasSubstr("p.toml:18: vehicle.mounting_file"), HasSubstr("tof-stern"), HasSubstr("tof Helios")));
  EXPECT_THAT(error_with({"slam"}, sources + kVehicle), HasSubstr("no source whose feature is known"));
  EXPECT_THAT(error_with({"tof"}, sources + kVehicle + "motion = 'tumbling'\ninertia = [1, 1, 5]\n"),
              HasSubstr("moments of inertia"));
  EXPECT_THAT(error_with({"tof"}, sources + kVehicle + "target = 'debris'\n"), HasSubstr("has no source"));
}

TEST(VehicleConfig, OneStateIsOfOneTarget) {
  const std::string text = std::string(kSources) +
                           "[[camera]]\nname = 'b'\ntarget = 'debris'\ncamera_file = 'h.toml'\nserial = '9'\n" +
                           kVehicle;
  EXPECT_THAT(error_with({"lighthouse", "b", "helios"}, text), IsEmpty()) << "no lighthouse is called b";
  EXPECT_THAT(error_with({"lighthouse", "tof-b"}, text), AllOf(HasSubstr("vehicle.target"), HasSubstr("debris")));
  EXPECT_THAT(error_with({"lighthouse", "tof"}, text), HasSubstr("may be tof Helios or tof b"));
  EXPECT_THAT(bound(parse_with({"lighthouse", "tof"}, text + "target = 'client'\n")),
              ElementsAre("lighthouse=lighthouse", "tof=tof/Helios"));
}

TEST(VehicleConfig, EachOfSeveralLighthousesNeedsItsStation) {
  const std::string text = std::string(kSources) + kVehicle;
  const std::string left = "[[vehicle.station]]\nsource = 'lighthouse-l'\nid = '0a1b2c3d'\n";
  const std::string right = "[[vehicle.station]]\nsource = 'lighthouse-r'\nid = 'FFFF0001'\n";
  EXPECT_THAT(bound(parse_with({"lighthouse-l", "lighthouse-r"}, text + left + right)),
              ElementsAre("lighthouse-l=lighthouse0A1B2C3D", "lighthouse-r=lighthouseFFFF0001"));
  EXPECT_THAT(error_with({"lighthouse", "lighthouse-l"}, text + left), HasSubstr("each needs [[vehicle.station]]"));
  EXPECT_THAT(error_with({"lighthouse"}, text + right), HasSubstr("vehicle.station[0].source"));
  EXPECT_THAT(error_with({"lighthouse-l"}, text + "[[vehicle.station]]\nsource = 'lighthouse-l'\nid = 'x'\n"),
              HasSubstr("eight hex digits"));
}

TEST(VehicleConfig, ARecordingAndACameraHaveNoCommonTime) {
  std::string text = std::string(kSources) + kVehicle;
  text.replace(text.find("/dev/a"), 6, "replay:a");
  EXPECT_THAT(error_with({"lighthouse", "tof"}, text), HasSubstr("choose one kind with sources"));
  EXPECT_THAT(bound(parse_with({"lighthouse", "tof"}, text + "sources = ['lighthouse']\n")),
              ElementsAre("lighthouse=lighthouse"));
}

TEST(VehicleConfig, RecordedCamerasGoWithRecordedTargetsOnly) {
  std::string text = std::string(kSources) + kVehicle;
  const auto put = [&text](std::string_view what, std::string_view in_place_of) {
    text.replace(text.find(in_place_of), in_place_of.size(), what);
  };
  put("frames = 'recorded'", "serial = '1'");
  put("frames = 'recorded'", "left.serial = '2'\nright.serial = '3'");
  EXPECT_THAT(error_with({"lighthouse", "tof"}, text), HasSubstr("choose one kind with sources"));
  EXPECT_THAT(error_with({"lighthouse", "ring2"}, text), HasSubstr("choose one kind with sources"));
  put("replay:a", "/dev/a");
  EXPECT_THAT(bound(parse_with({"lighthouse", "tof", "ring2", "slam"}, text)),
              ElementsAre("lighthouse=lighthouse", "tof=tof/Helios", "ring2=ring2/bow", "slam=slam/bow"));
  put("drawings", "recorded");
  EXPECT_THAT(error_with({"lighthouse", "tof"}, text), HasSubstr("choose one kind with sources"));
}

TEST(VehicleConfig, TheRateChangesWhileRunningAndAMountingDoesNot) {
  const std::string text = std::string(kSources) + kVehicle;
  DaemonConfig config = parse_with({"lighthouse"}, text);
  EXPECT_THAT(take_live_changes(parse_with({"lighthouse"}, text + "rate_hz = 5\n"), config), IsEmpty());
  EXPECT_EQ(config.vehicle->rate_hz, 5.0);
  DaemonConfig moved = config;
  moved.vehicle->sources[0].mounting.time_offset_s = 0.5;
  EXPECT_THAT(take_live_changes(moved, config), ElementsAre("vehicle: /etc/pharos/m.toml has changed"));
  EXPECT_THAT(take_live_changes(parse_with({"lighthouse"}, text + "risk_per_hour = 1e-7\n"), config),
              Contains(HasSubstr("risk 1e-07")));
  EXPECT_THAT(take_live_changes(parse(kSources), config), Contains("without [vehicle]"));
}

TEST(VehicleConfig, TheShippedExampleHasEveryKeyWithItsDefault) {
  std::ifstream in(PHAROS_EXAMPLE_CONFIG);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    const bool key = line.size() > 1 && line[0] == '#' && (std::islower(line[1]) != 0 || line[1] == '[');
    text += (key ? line.substr(1) : line) + "\n";
  }
  const DaemonConfig config = parse(text.substr(text.find("\n[[target]]")));
  ASSERT_TRUE(config.vehicle.has_value());
  const VehicleConfig vehicle;
  const FusionChoices& fusion = config.vehicle->fusion;
  EXPECT_EQ(config.vehicle->rate_hz, vehicle.rate_hz);
  EXPECT_EQ(fusion.motion, vehicle.fusion.motion);
  EXPECT_EQ(fusion.mean_motion_rad_s, vehicle.fusion.mean_motion_rad_s);
  EXPECT_EQ(fusion.inertia, vehicle.fusion.inertia);
  EXPECT_EQ(fusion.acceleration_density, vehicle.fusion.acceleration_density);
  EXPECT_EQ(fusion.angular_acceleration_density, vehicle.fusion.angular_acceleration_density);
  EXPECT_EQ(fusion.bias_deg, vehicle.fusion.bias_deg);
  EXPECT_EQ(fusion.bias_mm, vehicle.fusion.bias_mm);
  EXPECT_EQ(fusion.bias_time_s, vehicle.fusion.bias_time_s);
  EXPECT_EQ(fusion.risk_per_hour, vehicle.fusion.risk_per_hour);
  EXPECT_EQ(fusion.faults_per_hour, vehicle.fusion.faults_per_hour);
}

}  // namespace
}  // namespace pharos::host
