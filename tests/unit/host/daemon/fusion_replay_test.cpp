// SPDX-License-Identifier: Apache-2.0
#include <csignal>

#include "host/daemon/daemon.hpp"
#include "host/record/stream_format.hpp"
#include "support/temporary_folder.hpp"
#include "tests/integration/stationary_target.hpp"
#include "unit/host/daemon/fusion_fixture.hpp"

namespace pharos::host {
namespace {

using test::a_vehicle;
using test::Fusion;
using test::kMs;

class FusionOfARecording : public Fusion {
 protected:
  FusionOfARecording() : Fusion(a_vehicle()) {
    TargetConfig target;
    target.name = "client";
    target.port = "replay:a.bin";
    bench.config.targets.push_back(target);
    bench.config.vehicle->rate_hz = 20.0;
  }
  // Bytes of all states.
  std::vector<std::vector<std::uint8_t>> run(std::uint64_t computer_ns) {
    bench.sink.entries.clear();
    random_.seed(7);
    normal_.reset();
    open();
    std::int64_t utc_ns = 1'700'000'000'000'000'000;
    for (int k = 0; k < 200; ++k) {
      utc_ns += 20 * kMs;
      bench.clock.advance(static_cast<std::int64_t>(computer_ns));
      CycleReport report = lighthouse();
      report.utc_ns = utc_ns;
      report.source = "lighthouse/chaser/replay";
      report.target = "client";
      gate.publish(report);
    }
    feed.reset();
    std::vector<std::vector<std::uint8_t>> bytes;
    for (const MessageList::Entry& entry : bench.sink.entries) {
      if (entry.channel == "PHAROS_TARGET_STATE") bytes.push_back(entry.bytes);
    }
    return bytes;
  }
};

TEST_F(FusionOfARecording, TheSamePosesGiveTheSameStatesBitByBitWhateverTheComputersClock) {
  const auto once = run(1000);
  EXPECT_EQ(once.size(), 200U + 79U) << "one a pose, and 20 a second";
  EXPECT_TRUE(once == run(33 * kMs));
  EXPECT_EQ(states().back().mode, "single");
}

// Bytes of a serial line to fused states, as `pharosd --replay FILE --fast` runs them.
TEST(FusionOfAReplay, TwoRunsOfTheDaemonPublishTheSameStatesBitByBit) {
  constexpr std::int64_t kUtc = 1'763'721'000'000'000'000;
  StationaryTarget board({rotation_exp(Vector3(0.2, 0.1, 0.0)), {0.1, 0.0, 1.8}});
  pharos::test::Bytes bytes = stream_format::encode_head({"client", 460'800, kUtc, 0});
  const auto add = [&](std::int64_t ticks, const StationaryTarget::Bytes& frame) {
    const std::int64_t now_ns = ticks * 20 + 2 * kMs;
    stream_format::append_chunk({kUtc + now_ns, now_ns, 0, {frame.data(), frame.size()}}, bytes);
  };
  for (std::int64_t k = 1; k <= 240; ++k) {  // 4 s
    add(k * StationaryTarget::kTurn_ticks, board.cycle(k * StationaryTarget::kTurn_ticks));
    if (k % 30 == 0) add(k * StationaryTarget::kTurn_ticks, board.ootx(k * StationaryTarget::kTurn_ticks, 0x0A1B2C3D));
  }
  const pharos::test::TemporaryFolder folder;
  pharos::test::write_file(folder.path() / "r.phraw", bytes);
  DaemonConfig config;
  config.targets.resize(1);
  config.targets[0].name = "client";
  config.targets[0].port = "replay:" + (folder.path() / "r.phraw").string();
  config.targets[0].target = StationaryTarget::target();
  config.vehicle = a_vehicle();
  config.vehicle->rate_hz = 20.0;
  const auto run = [&] {
    MessageList sink;
    Signals signals{SIGUSR2};
    const SystemClock clock;
    Daemon(config, sink, signals, ReplaySpeed::kFastest, clock).run();
    std::vector<std::vector<std::uint8_t>> states;
    for (const MessageList::Entry& entry : sink.entries) {
      if (entry.channel == "PHAROS_TARGET_STATE") states.push_back(entry.bytes);
    }
    const auto decoded = sink.all<target_state_t>("PHAROS_TARGET_STATE");
    EXPECT_FALSE(decoded.empty());
    EXPECT_EQ(decoded.empty() ? "" : decoded.back().mode, "single");
    return states;
  };
  const auto once = run();
  EXPECT_GT(once.size(), 150U);
  EXPECT_TRUE(once == run());
}

}  // namespace
}  // namespace pharos::host
