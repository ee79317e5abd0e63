// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/tof_scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kStill = "[trajectory]\nkind = \"still\"\nposes = [[0, 0, 3, 0, 0, 0]]\n";

TofScenario read(const std::string& text) {
  const fs::path path = fs::path(::testing::TempDir()) / "tof_scenario_test.toml";
  std::ofstream(path) << text;
  return read_tof_scenario(path, 1);
}

std::string message(const std::string& text) {
  return pharos::test::error_of([&] { read(text); });
}

TEST(TofScenario, WhatTheFileLeavesOutIsTheDefault) {
  const TofScenario scenario = read(kStill);
  EXPECT_EQ(scenario.poses.size(), 1u);
  EXPECT_EQ(scenario.lens.fx_px, 608.61);
  EXPECT_EQ(scenario.satellite.connectors.size(), 2u);
  EXPECT_NEAR(scenario.satellite.ring->outer_radius_m, 0.55, 1e-12);
  EXPECT_FALSE(scenario.satellite.occluder);
}

TEST(TofScenario, EveryMeasureGoesWithTheRing) {
  const TofScenario scenario = read(std::string("[satellite]\nring_outer_diameter_m = 0.6\n") + kStill);
  EXPECT_NEAR(scenario.satellite.ring->outer_radius_m, 0.3, 1e-12);
  EXPECT_NEAR(scenario.satellite.connectors[0].distance_m, 0.36, 1e-12);
}

TEST(TofScenario, ReportsFileLineAndKeyOfWhatItRefuses) {
  EXPECT_THAT(message(std::string("blur = 1\n") + kStill), HasSubstr("tof_scenario_test.toml:1: blur"));
  EXPECT_THAT(message(std::string("[sensor]\nblur_px = -1\n") + kStill), HasSubstr(":2: sensor.blur_px"));
  EXPECT_THAT(message("[trajectory]\nkind = \"still\"\nposes = [[0, 0, -3, 0, 0, 0]]\n"), HasSubstr(":3: "));
  EXPECT_THAT(message(std::string("[satellite]\nring_inner_diameter_m = 2\n") + kStill),
              HasSubstr("satellite.ring_inner_diameter_m"));
  EXPECT_THAT(message(std::string("[camera]\ndistortion = [-3, 0, 0, 0, 0]\n[trajectory]\nkind = \"random\"\n") +
                      "count = 1\n"),
              HasSubstr("distortion"));
  EXPECT_THAT(message(std::string("[satellite]\nring = false\n[occluder]\n") + kStill), HasSubstr("occluder"));
}

TEST(TofScenario, TheSeedDecidesRandomPoses) {
  const fs::path path = fs::path(PHAROS_SCENARIOS) / "tof_large_ring.toml";
  const TofScenario one = read_tof_scenario(path, 1);
  EXPECT_EQ(one.poses.size(), 100u);
  EXPECT_EQ(one.poses[5].t, read_tof_scenario(path, 1).poses[5].t);
  EXPECT_NE(one.poses[5].t, read_tof_scenario(path, 2).poses[5].t);
}

TEST(TofScenario, EveryScenarioThatShipsCanBeRead) {
  int read_files = 0;
  for (const auto& entry : fs::directory_iterator(PHAROS_SCENARIOS)) {
    if (entry.path().filename().string().starts_with("tof_")) {
      EXPECT_FALSE(read_tof_scenario(entry.path(), 1).poses.empty()) << entry.path();
      ++read_files;
    }
  }
  EXPECT_GE(read_files, 8);
}

}  // namespace
}  // namespace pharos::sim
