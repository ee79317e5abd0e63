// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "tests/unit/sim/simulated_light.hpp"
#include "tools/sim/serial_player.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;
using lighthouse::RawPulse;

PulseFeed feed_of(std::vector<RawPulse> pulses) {
  auto next = std::make_shared<std::size_t>(0);
  auto held = std::make_shared<std::vector<RawPulse>>(std::move(pulses));
  return PulseFeed([next, held]() -> std::optional<RawPulse> {
    if (*next == held->size()) return std::nullopt;
    return (*held)[(*next)++];
  });
}

std::vector<RawPulse> scenario_pulses(double duration_s) {
  LighthouseScenario scenario = noise_free_scenario();
  scenario.duration_s = duration_s;
  LighthouseSimulator simulator(scenario, 1);
  std::vector<RawPulse> pulses;
  while (const auto p = simulator.next()) pulses.push_back({p->rise_ticks, p->fall_ticks, p->sensor});
  return pulses;
}

std::vector<report::LinkEvent> events_in(const std::vector<std::uint8_t>& bytes,
                                         wire::LinkCounters* counters = nullptr) {
  report::LinkDecoder decoder;
  std::vector<report::LinkEvent> events;
  for (const std::uint8_t byte : bytes) {
    if (const auto event = decoder.push(byte)) events.push_back(*event);
  }
  if (counters != nullptr) *counters = decoder.counters();
  return events;
}

template <class T>
std::size_t count_of(const std::vector<report::LinkEvent>& events) {
  return static_cast<std::size_t>(std::count_if(
      events.begin(), events.end(), [](const report::LinkEvent& event) { return std::holds_alternative<T>(event); }));
}

TEST(PulseFeed, WaitsForGapsButNotForStalePulses) {
  std::vector<RawPulse> pulses;
  for (int i = 0; i < 15; ++i) pulses.push_back({700'000'000 + i, 700'068'000 + i, 1});
  for (int i = 0; i < 200; ++i) pulses.push_back({i * 10'000, i * 10'000 + 100, 2});
  for (int i = 0; i < 200; ++i) pulses.push_back({5'000'000'000 + i * 10'000, 5'000'000'100 + i * 10'000, 2});
  PulseFeed feed = feed_of(pulses);
  EXPECT_EQ(feed.first_ticks(), 100);
  std::int64_t last = 0;
  std::size_t played = 0;
  for (; const PulseFeed::Due* due = feed.peek(); feed.pop(), ++played) {
    EXPECT_GE(due->due_ticks, last);
    last = due->due_ticks;
    if (played < 15) {
      EXPECT_EQ(due->due_ticks, 100) << "stale pulses are given out at once";
    }
    if (played == 300) {
      EXPECT_GT(due->due_ticks, 5'000'000'000);
    }
  }
  EXPECT_EQ(played, pulses.size());
}

TEST(SimulatedTarget, SaysHelloFirstAndThenEverythingThatTheDecoderFinds) {
  SimulatedTarget target({"probe", 0xFFFu, 7, wire::kModeSweeps});
  lighthouse::Decoder reference;
  std::uint32_t sweeps = 0;
  std::int64_t next = 0;
  for (const RawPulse& pulse : scenario_pulses(4.0)) {
    reference.push(pulse);
    while (reference.take_sweep()) ++sweeps;
    while (reference.take_ootx()) {
    }
    target.push(pulse);
    if (pulse.fall_ticks > next) {
      target.advance(pulse.fall_ticks);
      next = pulse.fall_ticks + 50'000;
    }
  }
  target.finish();
  reference.flush();
  while (reference.take_sweep()) ++sweeps;
  std::vector<std::uint8_t> line;
  for (const auto& frame : target.frames()) line.insert(line.end(), frame.begin(), frame.end());
  wire::LinkCounters counters;
  const std::vector<report::LinkEvent> events = events_in(line, &counters);
  ASSERT_FALSE(events.empty());
  ASSERT_TRUE(std::holds_alternative<wire::Hello>(events[0]));
  EXPECT_EQ(count_of<lighthouse::Sweep>(events), sweeps);
  EXPECT_GT(sweeps, 400u);
  EXPECT_GE(count_of<wire::Hello>(events), 4u);
  EXPECT_NEAR(static_cast<double>(count_of<wire::Time>(events)), 40.0, 2.0);
  EXPECT_GE(count_of<report::DecoderReport>(events), 4u);
  for (const report::LinkEvent& event : events) {
    if (const auto* hello = std::get_if<wire::Hello>(&event)) {
      EXPECT_EQ(hello->target.view(), "probe");
      EXPECT_EQ(hello->role, wire::Role::kSimulator);
    }
  }
}

TEST(SimulatedTarget, RawEdgesAreEveryPulseTwiceInOrder) {
  SimulatedTarget target({"", 0xFFFu, 7, wire::kModeRawEdges});
  const std::vector<RawPulse> pulses = scenario_pulses(1.0);
  for (const RawPulse& pulse : pulses) {
    target.push(pulse);
    target.advance(pulse.fall_ticks);
  }
  target.finish();
  std::vector<std::uint8_t> line;
  for (const auto& frame : target.frames()) line.insert(line.end(), frame.begin(), frame.end());
  std::size_t edges = 0;
  std::int64_t last = 0;
  for (const report::LinkEvent& event : events_in(line)) {
    EXPECT_FALSE(std::holds_alternative<lighthouse::Sweep>(event));
    if (const auto* report = std::get_if<report::EdgesReport>(&event)) {
      for (const lighthouse::Edge& edge : report->edges) {
        EXPECT_GE(edge.stamp_ticks, last);
        last = edge.stamp_ticks;
        ++edges;
      }
    }
  }
  EXPECT_EQ(edges, 2 * pulses.size());
}

TEST(SimulatedTarget, RepliesToTheHost) {
  SimulatedTarget target({"", 0xFFFu, 7, wire::kModeSweeps});
  target.advance(1000);
  target.frames().clear();
  wire::FrameEncoder encoder;
  const auto send = [&](wire::CommandCode code, std::uint32_t value) {
    std::array<std::uint8_t, wire::Command::kMaxBytes> payload{};
    std::array<std::uint8_t, wire::kMaxLineFrame> line{};
    const std::size_t size = wire::encode_payload(wire::Command{code, value}, payload);
    const std::size_t bytes = encoder.encode(wire::MessageType::kCommand, {payload.data(), size}, line);
    target.receive({line.data(), bytes});
    std::vector<std::uint8_t> answer;
    for (const auto& frame : target.frames()) answer.insert(answer.end(), frame.begin(), frame.end());
    target.frames().clear();
    return events_in(answer);
  };
  const auto identified = send(wire::CommandCode::kIdentify, 0);
  EXPECT_EQ(count_of<wire::Ack>(identified), 1u);
  EXPECT_EQ(count_of<wire::Hello>(identified), 1u);
  const auto modes = send(wire::CommandCode::kSetModes, wire::kModeRawEdges | wire::kModePoses);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_EQ(std::get<wire::Ack>(modes[0]).value, static_cast<std::uint32_t>(wire::kModeRawEdges));
  EXPECT_EQ(count_of<wire::Nak>(send(wire::CommandCode::kEnterLoader, 0)), 1u);
}

class Line : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() /
                 (std::string("pharos_line_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  // Reads the port at `link`, whenever it exists, until stopped.
  std::vector<std::uint8_t> read_until(const fs::path& link, const std::atomic<bool>& stop) const {
    std::vector<std::uint8_t> bytes;
    host::UniqueFd port;
    while (!stop) {
      if (!port.valid()) port.reset(::open(link.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK));
      if (!port.valid()) {
        ::usleep(1000);
        continue;
      }
      std::uint8_t buffer[4096];
      const ssize_t size = ::read(port.get(), buffer, sizeof buffer);
      if (size > 0) bytes.insert(bytes.end(), buffer, buffer + size);
      if (size == 0 || (size < 0 && errno != EAGAIN)) port.reset();
      if (size <= 0) ::usleep(500);
    }
    return bytes;
  }

  struct Played {
    std::vector<std::uint8_t> bytes;
    SerialSummary summary;
  };
  Played play(const std::vector<RawPulse>& pulses, const SerialOptions& options,
              std::optional<PlayTruth> truth = std::nullopt) const {
    const fs::path link = directory_ / "target";
    PulseFeed feed = feed_of(pulses);
    const std::int64_t start = *feed.first_ticks();
    const PlayClock clock{[start](std::int64_t ticks) { return static_cast<double>(ticks - start) * 20e-9; },
                          [start](double time_s) { return start + std::llround(time_s * 50e6); }};
    SimulatedTarget target({"line", 0xFFFu, 7, wire::kModeSweeps});
    PseudoTerminal line(link);
    // Signals must be delivered to the player's thread.
    std::atomic<bool> stop = false;
    Played played;
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    std::thread reader([&] { played.bytes = read_until(link, stop); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    SerialPlayer player(feed, clock, target, line, options, std::move(truth));
    played.summary = player.play();
    stop = true;
    reader.join();
    return played;
  }

  fs::path directory_;
};

TEST_F(Line, EveryFrameOfAFastPlaybackArrives) {
  SerialOptions options;
  options.speed = 0.0;
  const Played played = play(scenario_pulses(3.0), options);
  wire::LinkCounters counters;
  const std::vector<report::LinkEvent> events = events_in(played.bytes, &counters);
  EXPECT_EQ(count_of<lighthouse::Sweep>(events), played.summary.sweeps);
  EXPECT_EQ(played.summary.bytes, played.bytes.size());
  ASSERT_FALSE(events.empty());
  EXPECT_TRUE(std::holds_alternative<wire::Hello>(events[0]));
}

TEST_F(Line, RealSpeedIsKept) {
  SerialOptions options;
  options.speed = 4.0;
  const auto start = std::chrono::steady_clock::now();
  const Played played = play(scenario_pulses(2.0), options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(seconds, 0.49) << "never faster than asked; a busy machine may be slower";
  EXPECT_GE(count_of<lighthouse::Sweep>(events_in(played.bytes)) + played.summary.frames_skipped,
            played.summary.sweeps);
}

TEST_F(Line, ALineTooSlowGivesUpFramesAndSaysHowMany) {
  SerialOptions options;
  options.speed = 8.0;
  options.baud = 9600;
  const Played played = play(scenario_pulses(4.0), options);
  EXPECT_GT(played.summary.frames_skipped, 100u);
  wire::LinkCounters counters;
  EXPECT_LT(count_of<lighthouse::Sweep>(events_in(played.bytes, &counters)), played.summary.sweeps);
}

TEST_F(Line, CorruptedBytesCostTheirFramesAndNoOthers) {
  SerialOptions options;
  options.speed = 0.0;
  options.corrupt_rate = 0.0005;
  options.drop_rate = 0.0005;
  const Played played = play(scenario_pulses(5.0), options);
  const std::uint64_t faults = played.summary.bytes_corrupted + played.summary.bytes_dropped;
  EXPECT_GT(faults, 5u);
  const std::size_t sweeps = count_of<lighthouse::Sweep>(events_in(played.bytes));
  EXPECT_LT(sweeps, played.summary.sweeps);
  EXPECT_GE(sweeps + 2 * faults, played.summary.sweeps) << "a lost border joins two frames: at most two a fault";
}

TEST_F(Line, AnUnpluggedPortVanishesAndComesBackWithHello) {
  SerialOptions options;
  options.speed = 4.0;
  options.unplugs = {{1.0, 1.0}};
  const Played played = play(scenario_pulses(3.0), options);
  std::set<int> starts;
  for (const report::LinkEvent& event : events_in(played.bytes)) {
    if (const auto* hello = std::get_if<wire::Hello>(&event)) starts.insert(hello->start_count);
  }
  EXPECT_EQ(starts.size(), 2u);
  const auto received = static_cast<double>(count_of<lighthouse::Sweep>(events_in(played.bytes)));
  EXPECT_NEAR(received, 2.0 / 3.0 * played.summary.sweeps, 0.15 * played.summary.sweeps);
}

TEST_F(Line, TruthIsWrittenInUtcAsItPlays) {
  SerialOptions options;
  options.speed = 10.0;
  const PlayTruth truth{[](std::size_t, double time_s) {
                          return LighthouseFromBody{facing(), {time_s, 0.0, 2.0}};
                        },
                        1, 1.0, directory_ / "truth.csv"};
  const auto now_us = [] {
    return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
  const std::int64_t before_us = now_us();
  play(scenario_pulses(1.0), options, truth);
  const std::int64_t after_us = now_us();
  std::ifstream in(directory_ / "truth.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "utime,station,qw,qx,qy,qz,tx_m,ty_m,tz_m");
  long long first = 0;
  int rows = 0;
  while (std::getline(in, line)) {
    long long utime = 0;
    double v[8];
    ASSERT_EQ(std::sscanf(line.c_str(), "%lld,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &utime, v, v + 1, v + 2, v + 3, v + 4,
                          v + 5, v + 6, v + 7),
              9);
    EXPECT_GE(utime, before_us);
    EXPECT_LE(utime, after_us);
    if (rows == 0) first = utime;
    EXPECT_NEAR(static_cast<double>(utime - first) * 1e-6 * 10.0, v[5], 2e-5) << "ten times real speed";
    ++rows;
  }
  EXPECT_GT(rows, 150);
}

TEST_F(Line, TheLinkFollowsThePortAndLeavesNothingBehind) {
  const fs::path link = directory_ / "port";
  {
    PseudoTerminal line(link);
    EXPECT_EQ(fs::read_symlink(link), fs::path(line.path()));
    EXPECT_FALSE(line.opened());
    const host::UniqueFd port(::open(link.c_str(), O_RDWR | O_NOCTTY));
    EXPECT_TRUE(line.opened());
    line.unplug();
    EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
    line.plug_in();
    EXPECT_TRUE(fs::is_symlink(link));
  }
  EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
  std::ofstream(link) << "something else";
  EXPECT_THROW(PseudoTerminal line(link), host::InputError);
}

}  // namespace
}  // namespace pharos::sim
