// SPDX-License-Identifier: Apache-2.0
#include "rtl/edges_player.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <random>
#include <tuple>

#include "firmware/rtl/capture_registers.h"

namespace pharos::rtl {
namespace {

using lighthouse::RawPulse;

// Pulses paired from records, as the firmware does.
std::vector<std::tuple<std::int64_t, std::int64_t, int>> pulses_of(const PlayedEdges& played) {
  std::vector<std::tuple<std::int64_t, std::int64_t, int>> pulses;
  std::array<std::uint32_t, 32> rise{};
  for (const RecordWords& record : played.records) {
    for (int sensor = 0; sensor < 32; ++sensor) {
      if ((record.changed >> sensor & 1) == 0) continue;
      if ((record.levels >> sensor & 1) != 0) {
        rise[static_cast<std::size_t>(sensor)] = record.time;
      } else {
        pulses.emplace_back(rise[static_cast<std::size_t>(sensor)], record.time, sensor);
      }
    }
  }
  return pulses;
}

std::vector<RawPulse> some_pulses(std::int64_t start, int count) {
  std::mt19937_64 random(7);
  std::vector<RawPulse> pulses;
  std::array<std::int64_t, 32> free_at{};
  free_at.fill(start);
  for (int i = 0; i < count; ++i) {
    const auto sensor = static_cast<std::uint8_t>(random() % 32);
    const std::int64_t rise = free_at[sensor] + 1 + static_cast<std::int64_t>(random() % 30'000);
    const std::int64_t fall = rise + 1 + static_cast<std::int64_t>(random() % 5'000);
    free_at[sensor] = fall;
    pulses.push_back({rise, fall, sensor});
  }
  return pulses;
}

std::vector<std::tuple<std::int64_t, std::int64_t, int>> expected(const std::vector<RawPulse>& pulses) {
  std::vector<std::tuple<std::int64_t, std::int64_t, int>> result;
  result.reserve(pulses.size());
  for (const RawPulse& pulse : pulses) result.emplace_back(pulse.rise_ticks, pulse.fall_ticks, pulse.sensor);
  return result;
}

TEST(EdgesPlayer, GivesBackEveryPulseToTheTick) {
  const auto pulses = some_pulses(1'000'000, 2'000);
  const PlayedEdges played = play_edges(pulses);
  EXPECT_EQ(played.lost_edges, 0u);
  EXPECT_EQ(played.pulses_left_out, 0u);
  EXPECT_THAT(pulses_of(played), testing::UnorderedElementsAreArray(expected(pulses)));
}

TEST(EdgesPlayer, StampsAreTheLowWordOfLateAndOfNegativeTicks) {
  for (const std::int64_t start : {std::int64_t{5} << 32, (std::int64_t{1} << 32) - 10, std::int64_t{-500}}) {
    const PlayedEdges played = play_edges(std::vector<RawPulse>{{start, start + 100, 3}});
    ASSERT_EQ(played.records.size(), 2u);
    EXPECT_EQ(played.records[0].time, static_cast<std::uint32_t>(start));
    EXPECT_EQ(played.records[1].time, static_cast<std::uint32_t>(start + 100));
    EXPECT_EQ(played.records[0].changed, 8u);
  }
}

TEST(EdgesPlayer, SkippingIdleTicksChangesNoWord) {
  const auto pulses = some_pulses(0, 300);
  const PlayedEdges quick = play_edges(pulses, {.service_ticks = 333, .skip_idle = true});
  const PlayedEdges whole = play_edges(pulses, {.service_ticks = 333, .skip_idle = false});
  EXPECT_EQ(quick.records, whole.records);
  EXPECT_LT(quick.simulated_ticks, whole.simulated_ticks);
}

TEST(EdgesPlayer, ASlowReaderLosesEdgesWhichAreCountedAndMarked) {
  std::vector<RawPulse> pulses;
  pulses.reserve(2'000);
  for (int i = 0; i < 2'000; ++i) pulses.push_back({i * 20, i * 20 + 10, 0});
  const PlayedEdges played = play_edges(pulses, {.service_ticks = 100});
  std::size_t recorded = 0;
  std::size_t gaps = 0;
  for (const RecordWords& record : played.records) {
    recorded += static_cast<std::size_t>(std::popcount(record.changed));
    gaps += (record.status & PHAROS_CAPTURE_STATUS_GAP) != 0;
  }
  EXPECT_GT(played.lost_edges, 0u);
  EXPECT_EQ(recorded + played.lost_edges, 2 * pulses.size());
  EXPECT_GT(gaps, 1u);  // the first record after enabling has one too
  EXPECT_EQ(played.worst_fill, 512u);
}

TEST(EdgesPlayer, LeavesOutAndCountsWhatPinsCannotShow) {
  const PlayedEdges played = play_edges(
      std::vector<RawPulse>{{100, 200, 0}, {150, 250, 0}, {200, 300, 0}, {400, 400, 1}, {500, 450, 1}, {600, 700, 99}});
  EXPECT_EQ(played.pulses_left_out, 5u);
  EXPECT_EQ(played.records.size(), 2u);
  EXPECT_TRUE(play_edges({}).records.empty());
}

}  // namespace
}  // namespace pharos::rtl
