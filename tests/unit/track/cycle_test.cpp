// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/cycle.hpp"

#include <gtest/gtest.h>

namespace pharos::track {
namespace {

constexpr std::int64_t kHalfTurn_ticks = 416'667;

lighthouse::SweepBearings bearings(int count) {
  lighthouse::SweepBearings result;
  for (int i = 0; i < count; ++i) result.push_back({});
  return result;
}

TEST(CycleAssembler, YClosesTheCycleThatXOpened) {
  CycleAssembler assembler;
  EXPECT_FALSE(assembler.push(1, Axis::kX, 0, 1, bearings(3)));
  const auto cycle = assembler.push(1, Axis::kY, kHalfTurn_ticks, 2, bearings(4));
  ASSERT_TRUE(cycle);
  EXPECT_EQ(cycle->station, 1);
  EXPECT_EQ((*cycle)[Axis::kX].size(), 3u);
  EXPECT_EQ((*cycle)[Axis::kY].size(), 4u);
  EXPECT_EQ(cycle->sweep_flags, 3);
  EXPECT_EQ(cycle->last_flash_ticks, kHalfTurn_ticks);
  EXPECT_FALSE(assembler.flush());
}

TEST(CycleAssembler, AMissingYIsAnsweredByTheNextX) {
  CycleAssembler assembler;
  assembler.push(0, Axis::kX, 0, 0, bearings(3));
  const auto cycle = assembler.push(0, Axis::kX, 2 * kHalfTurn_ticks, 0, bearings(5));
  ASSERT_TRUE(cycle);
  EXPECT_EQ((*cycle)[Axis::kX].size(), 3u);
  EXPECT_FALSE(cycle->has_sweep[1]);
  const auto next = assembler.push(0, Axis::kY, 3 * kHalfTurn_ticks, 0, bearings(2));
  ASSERT_TRUE(next);
  EXPECT_EQ((*next)[Axis::kX].size(), 5u);
}

TEST(CycleAssembler, AMissingXLeavesYAlone) {
  CycleAssembler assembler;
  const auto cycle = assembler.push(0, Axis::kY, 0, 0, bearings(3));
  ASSERT_TRUE(cycle);
  EXPECT_FALSE(cycle->has_sweep[0]);
  EXPECT_TRUE(cycle->has_sweep[1]);
}

TEST(CycleAssembler, NeverJoinsSweepsOfDifferentTurns) {
  CycleAssembler assembler;
  assembler.push(0, Axis::kX, 0, 0, bearings(3));
  const auto first = assembler.push(0, Axis::kY, 3 * kHalfTurn_ticks, 0, bearings(4));
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->has_sweep[1]);
  const auto second = assembler.flush();
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->has_sweep[0]);
  EXPECT_EQ((*second)[Axis::kY].size(), 4u);
}

TEST(CycleAssembler, LosesNoSweepWhateverTheOrder) {
  CycleAssembler assembler;
  int given = 0;
  int taken = 0;
  unsigned state = 1;
  std::int64_t flash = 0;
  const auto count = [&taken](const std::optional<Cycle>& cycle) {
    if (cycle) taken += cycle->has_sweep[0] + cycle->has_sweep[1];
  };
  for (int i = 0; i < 10'000; ++i) {
    state = state * 1664525u + 1013904223u;
    const std::int64_t step = ((state >> 20) % 4 + 1) * kHalfTurn_ticks;
    flash += (state >> 30) == 0 ? -step : step;
    count(assembler.push(0, (state >> 16) & 1 ? Axis::kX : Axis::kY, flash, 0, bearings(1)));
    ++given;
  }
  while (const auto rest = assembler.flush()) count(rest);
  EXPECT_EQ(given, taken);
}

}  // namespace
}  // namespace pharos::track
