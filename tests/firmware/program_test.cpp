// SPDX-License-Identifier: Apache-2.0
// The target's program on a simulated board: its first frames, responses, discarded work and counters.
#include "firmware/app/program.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "pharos/base/ticks.hpp"
#include "pharos/report/link_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"

namespace pharos::app {
namespace {

struct Restarted {
  bool stay_in_loader;
};

class TestBoard final : public hal::EdgeCapture, public hal::SerialLine, public hal::System {
 public:
  bool read(hal::CaptureRecord& record) override {
    if (records.empty()) return false;
    record = records.front();
    records.pop_front();
    return true;
  }
  std::int64_t now_ticks() override { return now; }
  std::uint32_t edges_lost() override { return lost; }
  bool take_overflow() override { return std::exchange(overflow, false); }
  std::uint32_t inputs() override { return 0xFFF; }

  std::size_t write(std::span<const std::uint8_t> bytes) override {
    const std::size_t count = std::min(room, bytes.size());
    room -= count;
    for (const std::uint8_t byte : bytes.first(count)) {
      if (const auto event = host.push(byte)) events.push_back(*event);
    }
    return count;
  }
  bool idle() override { return true; }
  std::optional<std::uint8_t> read() override {
    if (received.empty()) return std::nullopt;
    const std::uint8_t byte = received.front();
    received.pop_front();
    return byte;
  }
  std::uint32_t receive_errors() override { return 0; }

  std::uint32_t cycles() override { return cycles_now += cycles_a_call; }
  std::uint32_t clock_hz() override { return clock; }
  void feed_watchdog() override { ++fed; }
  void confirm_start() override { ++confirmed; }
  void restart(bool stay_in_loader) override { throw Restarted{stay_in_loader}; }
  wire::ResetCause reset_cause() override { return wire::ResetCause::kWatchdog; }
  std::uint16_t start_count() override { return 7; }
  std::uint32_t stack_never_used_bytes() override { return 321; }
  std::string_view board_name() override { return "test"; }
  std::uint32_t unique_id() override { return 0; }

  void command(wire::CommandCode code, std::uint32_t value) {
    std::array<std::uint8_t, wire::Command::kMaxBytes> payload{};
    std::array<std::uint8_t, wire::kMaxLineFrame> line{};
    const std::size_t size = wire::encode_payload(wire::Command{code, value}, payload);
    const std::size_t bytes = encoder.encode(wire::MessageType::kCommand, std::span(payload).first(size), line);
    received.insert(received.end(), line.begin(), line.begin() + static_cast<std::ptrdiff_t>(bytes));
  }
  template <class T>
  std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& event : events) {
      if (const auto* value = std::get_if<T>(&event)) found.push_back(*value);
    }
    return found;
  }

  std::deque<hal::CaptureRecord> records;
  std::deque<std::uint8_t> received;
  std::size_t room = SIZE_MAX;
  std::int64_t now = 5 * kTicksPerSecond;
  std::uint32_t lost = 0;
  bool overflow = false;
  std::uint32_t cycles_now = 0;
  std::uint32_t cycles_a_call = 0;
  std::uint32_t clock = 50'000'000;
  int fed = 0;
  int confirmed = 0;
  report::LinkDecoder host;
  std::vector<report::LinkEvent> events;
  wire::FrameEncoder encoder;
};

// A solver that is behind the sweeps.
class LateSolver final : public PoseSolver {
 public:
  void take(const lighthouse::Sweep&) override {}
  void take(const lighthouse::OotxPayload&) override {}
  report::Reporter::Bytes next_frame(report::Reporter&) override { return {}; }
  std::uint32_t sweeps_missed() override { return 17; }
  std::uint32_t take_busy_cycles() override { return 0; }
  bool solving() override { return false; }
  bool take_alive() override { return true; }
};

class ProgramTest : public testing::Test {
 protected:
  void run(std::int64_t ticks) { run(program, ticks); }
  void run(Program& any, std::int64_t ticks) {
    const std::int64_t end = board.now + ticks;
    for (; board.now < end; board.now += kTicksPerSecond / 1000) any.poll();
  }
  TestBoard board;
  Program program{hal::Board{board, board, board}, nullptr};
};

TEST_F(ProgramTest, SaysHelloFirstWithTheCauseOfItsStart) {
  board.command(wire::CommandCode::kIdentify, 0);  // already received when the program starts
  run(kTicksPerSecond / 100);
  ASSERT_FALSE(board.events.empty());
  const auto* hello = std::get_if<wire::Hello>(&board.events.front());
  ASSERT_NE(hello, nullptr);
  EXPECT_EQ(hello->reset_cause, wire::ResetCause::kWatchdog);
  EXPECT_EQ(hello->start_count, 7);
  EXPECT_EQ(hello->sensors, 0xFFFu);
  EXPECT_EQ(hello->board.view(), "test");
  EXPECT_EQ(board.all<wire::Ack>().size(), 1u);
  EXPECT_EQ(board.all<wire::Hello>().size(), 1u);  // which is also the requested one
}

TEST_F(ProgramTest, ReportsTimeTenTimesAndCountersOnceASecond) {
  run(5 * kTicksPerSecond);
  EXPECT_EQ(board.all<wire::Hello>().size(), 5u);
  EXPECT_EQ(board.all<report::DecoderReport>().size(), 5u);
  EXPECT_EQ(board.all<report::DeviceReport>().size(), 5u);
  EXPECT_EQ(board.all<wire::Time>().size(), 50u);
  EXPECT_EQ(board.all<report::DeviceReport>().back().counters.stack_free_bytes, 321u);
  EXPECT_EQ(board.host.counters().frames_lost, 0u);
}

// A thousand passes a second, each of 4,000 cycles.
TEST_F(ProgramTest, ReportsItsShareOfTheBoardsOwnClock) {
  for (const std::uint32_t clock : {50'000'000u, 16'000'000u}) {
    TestBoard any;
    any.clock = clock;
    any.cycles_a_call = 4000;
    Program busy{hal::Board{any, any, any}, nullptr};
    for (int pass = 0; pass < 3000; ++pass, any.now += kTicksPerSecond / 1000) {
      any.records.push_back({.time_ticks = static_cast<std::uint32_t>(any.now), .changed = 1, .levels = pass % 2 == 0});
      busy.poll();
    }
    const auto reports = any.all<report::DeviceReport>();
    ASSERT_GE(reports.size(), 2u);
    EXPECT_NEAR(reports.back().counters.busy_permille, 4e9 / clock, 0.01 * 4e9 / clock);
  }
}

TEST_F(ProgramTest, ReportsSweepsThatNoPoseWasMadeOf) {
  run(2 * kTicksPerSecond);
  EXPECT_EQ(board.all<report::DeviceReport>().back().counters.poses_skipped, 0u);
  LateSolver solver;
  Program posing{hal::Board{board, board, board}, &solver};
  run(posing, 2 * kTicksPerSecond);
  const auto counters = board.all<report::DeviceReport>().back().counters;
  EXPECT_EQ(counters.poses_skipped, 17u);
  EXPECT_EQ(counters.frames_skipped, 0u);
}

TEST_F(ProgramTest, RestartsOnlyAfterItsAckHasGoneOut) {
  run(kTicksPerSecond / 10);
  board.room = 0;
  board.command(wire::CommandCode::kEnterLoader, 0);
  EXPECT_NO_THROW(run(kTicksPerSecond / 10));
  board.room = SIZE_MAX;
  try {
    run(kTicksPerSecond / 10);
    FAIL() << "no restart";
  } catch (const Restarted& restarted) {
    EXPECT_TRUE(restarted.stay_in_loader);
  }
  EXPECT_EQ(board.all<wire::Ack>().size(), 1u);
}

TEST_F(ProgramTest, RefusesWhatItDoesNotKnow) {
  board.command(static_cast<wire::CommandCode>(99), 0);
  board.command(wire::CommandCode::kSetModes, wire::kModePoses | wire::kModeRawEdges);
  run(2 * kTicksPerSecond);
  ASSERT_EQ(board.all<wire::Nak>().size(), 1u);
  EXPECT_EQ(board.all<wire::Nak>().front().reason, wire::NakReason::kUnsupported);
  ASSERT_EQ(board.all<wire::Ack>().size(), 1u);
  EXPECT_EQ(board.all<wire::Ack>().front().value, wire::kModeRawEdges) << "this build solves no poses";
  EXPECT_EQ(board.all<report::DeviceReport>().back().counters.commands_refused, 1u);
}

TEST_F(ProgramTest, StarvesTheWatchdogWhenTheLineIsStuck) {
  run(kTicksPerSecond);
  board.room = 0;
  run(2 * kTicksPerSecond);
  const int fed = board.fed;
  run(kTicksPerSecond);
  EXPECT_EQ(board.fed, fed);
  board.room = SIZE_MAX;
  run(kTicksPerSecond / 10);
  EXPECT_GT(board.fed, fed);
}

TEST_F(ProgramTest, CountsWhatALineThatWasSilentDidNotCarry) {
  run(kTicksPerSecond / 2);
  board.room = 0;
  run(3 * kTicksPerSecond);
  board.room = SIZE_MAX;
  run(2 * kTicksPerSecond);
  const auto counters = board.all<report::DeviceReport>().back().counters;
  EXPECT_GT(counters.frames_skipped, 20u);  // periodic frames that were not sent
  EXPECT_EQ(board.host.counters().frames_lost, 0u) << "no number was used up by a frame that was never made";
}

TEST_F(ProgramTest, ReportsOverflowsAndRawEdgesThroughAGap) {
  board.command(wire::CommandCode::kSetModes, wire::kModeRawEdges);
  run(kTicksPerSecond / 10);
  const auto at = [&](int tick) { return static_cast<std::uint32_t>(board.now + tick); };
  board.records = {{at(0), 0b01, 0b01, false},
                   {at(9000), 0b10, 0b11, true},
                   {at(9100), 0b01, 0b10, false},
                   {at(9200), 0b10, 0b00, false}};
  board.lost = 6;
  board.overflow = true;
  board.now += 10'000;
  run(2 * kTicksPerSecond);
  std::vector<lighthouse::Edge> edges;
  for (const auto& report : board.all<report::EdgesReport>()) {
    EXPECT_EQ(report.edges_lost, 6u);
    edges.insert(edges.end(), report.edges.begin(), report.edges.end());
  }
  // Sensor 0 was lit at the gap: its rise is unknown, so its fall gives no pulse.
  ASSERT_EQ(edges.size(), 3u);
  EXPECT_TRUE(edges[0].rising && edges[0].sensor == 0);
  EXPECT_TRUE(edges[1].rising && edges[1].sensor == 1);
  EXPECT_TRUE(!edges[2].rising && edges[2].sensor == 1);
  const auto counters = board.all<report::DeviceReport>().back().counters;
  EXPECT_EQ(counters.capture_overflows, 1u);
  EXPECT_EQ(counters.edges_lost, 6u);
}

}  // namespace
}  // namespace pharos::app
