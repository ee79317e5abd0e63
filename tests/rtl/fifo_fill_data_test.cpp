// SPDX-License-Identifier: Apache-2.0
// Fill level of the FIFO with real light: prints the table of firmware/rtl/README.md (run with --verbose).
#include <gtest/gtest.h>

#include <cstdio>

#include "pharos/base/ticks.hpp"
#include "rtl/fifo_fill.hpp"
#include "unit/lighthouse/recordings.hpp"

namespace pharos::rtl {
namespace {

constexpr std::size_t kDepth = 512;
constexpr std::size_t kFlyingSensors = 12;
constexpr std::size_t kAllSensors = 32;
// 250 instructions an edge at 3 cycles each are 15 us: the slowest core for the decoder.
constexpr std::int64_t kService_us[] = {5, 15, 20, 30};
constexpr std::int64_t kSlowestService_us = 20;
constexpr std::int64_t kAbsent_us[] = {1'000, 8'333, 16'667, 33'333, 50'000};
// Longest time without reading: 3 turns of a rotor.
constexpr std::int64_t kLongestAbsence_us = 50'000;

class RealLight : public testing::TestWithParam<const char*> {};

void print_and_check(const char* name, std::size_t sensors, bool must_fit) {
  const auto pulses = test::recorded_pulses(name);
  const auto records = record_ticks(pulses, busiest_sensors(pulses, sensors));
  std::printf("| %s | %zu |", name, sensors);
  for (const std::int64_t us : kService_us) std::printf(" %zu |", worst_fill(records, microseconds_to_ticks(us)));
  for (const std::int64_t us : kAbsent_us) std::printf(" %zu |", max_in_window(records, microseconds_to_ticks(us)));
  std::printf("\n");
  if (!must_fit) return;
  EXPECT_LE(worst_fill(records, microseconds_to_ticks(kSlowestService_us)), kDepth / 2);
  EXPECT_LE(max_in_window(records, microseconds_to_ticks(kLongestAbsence_us)), kDepth);
}

TEST_P(RealLight, OnTwelveSensorsNeverFillsTheFifoHoweverSlowTheReader) {
  PHAROS_NEEDS_RECORDINGS();
  print_and_check(GetParam(), kFlyingSensors, true);
  print_and_check(GetParam(), kAllSensors, false);
}

INSTANTIATE_TEST_SUITE_P(Recordings, RealLight,
                         testing::Values("hmd_static", "controller_quick", "two_bodies_hmd", "two_bodies_controller"));

}  // namespace
}  // namespace pharos::rtl
