// SPDX-License-Identifier: Apache-2.0
// The whole table 1 of paper 004, and the walk of 60 m: the requirements of `pharos slam`. Own renderer: POV-Ray takes
// hours (`pharos reproduce slam`).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "host/vision/slam/slam_system.hpp"
#include "tools/evaluation/reproduce/slam/body_campaign.hpp"
#include "tools/evaluation/reproduce/slam/table_one.hpp"
#include "tools/sim/stereo_tumbling/room_sequence.hpp"

namespace pharos::slam {
namespace {

struct Bounds {
  double rmse_deg, last_deg;  // last_deg: of the longest turn only
};

void expect_table_one(const std::string& run, const Bounds& bounds) {
  tools::TableOneOptions options;
  options.runs = {run};
  options.povray = false;
  int turns = 0, closed = 0;
  for (const tools::ComparisonRow& row : tools::reproduce_table_one(options).rows) {
    const std::string name = row.item + ", " + row.what;
    if (row.what == "attitude RMSE") {
      ++turns;
      EXPECT_LE(row.ours, bounds.rmse_deg) << name;
    } else if (row.what == "error of the last attitude") {
      const bool longest = row.item.find("720") != std::string::npos;
      EXPECT_LE(row.ours, longest ? bounds.last_deg : bounds.rmse_deg) << name;
    } else if (row.what == "frames without a pose") {
      EXPECT_EQ(row.ours, 0.0) << name;
    } else if (row.what == "loops closed") {
      ++closed;
      EXPECT_GE(row.ours, 1.0) << name;
    }
  }
  EXPECT_EQ(turns, 6);
  EXPECT_EQ(closed, 2);
}

TEST(SlamCampaign, GoodLight) { expect_table_one("good", {0.1, 0.1}); }

TEST(SlamCampaign, LowLightEnhanced) { expect_table_one("low-enhanced", {0.2, 0.3}); }

// Satellites drawn at random, two of four with symmetric parts.
TEST(SlamCampaign, ATurnOfRandomBodies) {
  tools::BodyCampaign campaign;
  std::vector<double> rmse_deg;
  for (const std::uint64_t seed : {41u, 42u, 43u, 44u}) {
    const tools::BodyFigures body = tools::run_body(campaign, seed);
    EXPECT_EQ(body.loops_wrong, body.loops_taken_back) << seed;
    EXPECT_EQ(body.lost, 0) << seed;
    EXPECT_LE(body.rmse_deg, 0.25) << seed;
    rmse_deg.push_back(body.rmse_deg);
  }
  std::sort(rmse_deg.begin(), rmse_deg.end());
  EXPECT_LE(0.5 * (rmse_deg[1] + rmse_deg[2]), 0.08);
}

// Raw images with a rig file; errors are computed without alignment.
TEST(SlamCampaign, AWalkOfSixtyMetres) {
  const sim::RoomSequence room({}, 1);
  SlamSettings settings;
  settings.scene = Scene::kStatic;
  const auto slam = make_slam(room.rig(), "rig.toml", settings);
  for (int k = 0; k < room.frames(); ++k) {
    std::array<std::vector<std::uint8_t>, 2> pair;
    for (int side = 0; side < 2; ++side) {
      for (const std::uint16_t value : room.image(k, side).pixels) {
        pair[static_cast<std::size_t>(side)].push_back(static_cast<std::uint8_t>(value >> 8U));
      }
    }
    slam->push(0.05 * k, {pair[0].data(), 752, 480}, {pair[1].data(), 752, 480});
  }
  slam->finish();
  double squares_m2 = 0.0;
  int placed = 0;
  for (const TrackedFrame& frame : slam->trajectory()) {
    if (!frame.placed) continue;
    squares_m2 += (frame.placed->pose.inverse().t - room.truth(static_cast<int>(frame.number)).t).squaredNorm();
    ++placed;
  }
  EXPECT_EQ(placed, room.frames());
  EXPECT_LE(std::sqrt(squares_m2 / placed), 0.03);
  EXPECT_GE(slam->report().loops, 1);
}

}  // namespace
}  // namespace pharos::slam
