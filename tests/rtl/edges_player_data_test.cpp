// SPDX-License-Identifier: Apache-2.0
// Real light on the pins: a second of every recording through the capture block, read by a slow reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "pharos/base/ticks.hpp"
#include "rtl/edges_player.hpp"
#include "unit/lighthouse/recordings.hpp"

namespace pharos::rtl {
namespace {

constexpr std::int64_t kFrom = 2 * kTicksPerSecond;  // after the stale rows at the beginning of two recordings
constexpr std::int64_t kTo = 3 * kTicksPerSecond;

class RealEdges : public testing::TestWithParam<const char*> {};

TEST_P(RealEdges, AllPassThroughTheBlockToTheTick) {
  PHAROS_NEEDS_RECORDINGS();
  auto pulses = test::recorded_pulses(GetParam());
  const std::int64_t start = std::ranges::min_element(pulses, {}, &lighthouse::RawPulse::rise_ticks)->rise_ticks;
  std::erase_if(pulses, [&](const lighthouse::RawPulse& pulse) {
    return pulse.rise_ticks < start + kFrom || pulse.rise_ticks >= start + kTo;
  });
  ASSERT_GT(pulses.size(), 500u);
  const PlayedEdges played = play_edges(pulses, {.service_ticks = 1'000});
  EXPECT_EQ(played.lost_edges, 0u);

  std::vector<std::pair<std::uint32_t, std::uint32_t>> given;  // tick, sensor and level
  std::vector<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (const auto& pulse : pulses) {
    given.emplace_back(static_cast<std::uint32_t>(pulse.rise_ticks), 2u * pulse.sensor + 1);
    given.emplace_back(static_cast<std::uint32_t>(pulse.fall_ticks), 2u * pulse.sensor);
  }
  for (const RecordWords& record : played.records) {
    for (unsigned sensor = 0; sensor < 32; ++sensor) {
      if ((record.changed >> sensor & 1) != 0)
        taken.emplace_back(record.time, 2 * sensor + (record.levels >> sensor & 1));
    }
  }
  std::ranges::sort(given);
  std::ranges::sort(taken);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> missing;
  std::ranges::set_difference(given, taken, std::back_inserter(missing));
  EXPECT_EQ(missing.size(), 2 * played.pulses_left_out);
  EXPECT_EQ(taken.size() + missing.size(), given.size());
  EXPECT_LT(played.pulses_left_out, pulses.size() / 100);
}

INSTANTIATE_TEST_SUITE_P(Recordings, RealEdges,
                         testing::Values("hmd_static", "controller_quick", "two_bodies_hmd", "two_bodies_controller"));

}  // namespace
}  // namespace pharos::rtl
