// SPDX-License-Identifier: Apache-2.0
// A simulated target before two Lighthouse 2.0 stations: its bytes to poses in the world.
#include <gtest/gtest.h>

#include <memory>

#include "host/daemon/lighthouse_pipeline.hpp"
#include "integration/stationary_target.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/report/reporter.hpp"
#include "tools/sim/lh2/lh2_feed.hpp"
#include "tools/sim/simulated_target.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {
namespace {

sim::LighthouseScenario two_lh2_stations() {
  sim::LighthouseScenario scenario;
  scenario.generation = 2;
  scenario.duration_s = 3.0;
  scenario.target = StationaryTarget::target();
  sim::StationScenario station;
  station.channel = 6;
  scenario.stations.push_back(station);
  station.channel = 1;
  station.id = 0xC33B4DE1;
  station.pose = {rotation_exp(Vector3(0.0, -kPi / 4, 0.0)), Vector3(1.6, 0.0, 0.8)};
  scenario.stations.push_back(station);
  sim::Sine slow{0.1, 0.3, 0.0};
  scenario.trajectory = std::make_shared<sim::SineTrajectory>(
      sim::RoomFromBody{rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.1, 0.0, 2.3)}, std::array{slow, slow, slow},
      std::array<sim::Sine, 3>{}, 0.0);
  return scenario;
}

TargetConfig world_config(const sim::Lh2Simulator& simulator) {
  TargetConfig config;
  config.name = "dock";
  config.generation = 2;
  config.target = simulator.nominal_target();
  for (const sim::Lh2SimStation& simulated : simulator.stations()) {
    network::Station station;
    station.number = static_cast<std::uint8_t>(simulated.channel);
    station.generation = network::Generation::kLighthouse2;
    station.T_world_station = network::WorldFromStation{simulated.pose.R, simulated.pose.t};
    station.sigmas = network::StationSigmas{1e-4, 1e-4, 5e-5};
    config.stations.push_back(station);
  }
  return config;
}

TEST(LighthouseWorld, BytesOfATargetOfLighthouse2BecomePosesInTheWorld) {
  sim::Lh2Simulator simulator(two_lh2_stations(), 5);
  sim::Lh2Feed feed(simulator);
  sim::TargetIdentity identity;
  identity.generation = 2;
  sim::SimulatedTarget target(identity);
  MessageList list;
  Publisher publisher(list, "PHAROS_");
  test::ManualClock clock;
  CalibrationMemory memory("");
  LighthousePipeline pipeline(world_config(simulator), PublishConfig{}, "lighthouse/test", publisher, clock, memory, 0);
  constexpr std::int64_t kStart_ns = 40'000'000'000;
  constexpr std::int64_t kUtc_ns = 1'700'000'000'000'000'000;
  std::int64_t now_ticks = simulator.clock().stamp(0.0);
  const std::int64_t first_ticks = now_ticks;
  for (; feed.due_ticks(); now_ticks += kTicksPerSecond / 1000) {
    while (feed.due_ticks() && *feed.due_ticks() <= now_ticks) feed.give(target);
    target.advance(now_ticks);
    const std::int64_t monotonic_ns = kStart_ns + (now_ticks - first_ticks) * 20;
    clock.advance(monotonic_ns - clock.monotonic_ns());
    while (!target.frames().empty()) {
      pipeline.push(target.frames().front(), {kUtc_ns + monotonic_ns, monotonic_ns});
      target.frames().pop_front();
    }
  }
  pipeline.end_of_input();
  const auto poses = list.all<pose_t>("PHAROS_LIGHTHOUSE_POSE");
  ASSERT_GE(poses.size(), 400U);  // 200 sweeps/s, without the first 0.3 s
  std::size_t ok = 0;
  for (const pose_t& pose : poses) {
    if (pose.status != "ok") continue;
    ++ok;
    EXPECT_EQ(pose.parent_frame, "world");
    EXPECT_EQ(pose.child_frame, "body");
    const double time_s = static_cast<double>(pose.utime * 1000 - kUtc_ns - kStart_ns) * 1e-9;
    const sim::RoomFromBody truth = simulator.truth(simulator.clock().counter_time(time_s));
    const Vector3 t(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
    EXPECT_LT((t - truth.t).norm(), 6e-3) << time_s;
    EXPECT_LT(pose.sigma_pos_m, 0.02);
  }
  EXPECT_GE(ok, poses.size() * 98 / 100);
  EXPECT_EQ(pipeline.counters().sweeps_bad_station, 0);
}

TEST(LighthouseWorld, SweepsOfTheOtherGenerationAreCounted) {
  MessageList list;
  Publisher publisher(list, "PHAROS_");
  test::ManualClock clock;
  CalibrationMemory memory("");
  TargetConfig config;
  config.target = StationaryTarget::target();
  LighthousePipeline pipeline(config, PublishConfig{}, "lighthouse/test", publisher, clock, memory, 0);
  report::Reporter reporter;
  lighthouse::Lh2Sweep sweep;
  sweep.hits.push_back({1, 300, 2'000'000});
  pipeline.push(reporter.report(sweep), {1, 1});
  EXPECT_EQ(pipeline.counters().sweeps_bad_station, 1);
}

}  // namespace
}  // namespace pharos::host
