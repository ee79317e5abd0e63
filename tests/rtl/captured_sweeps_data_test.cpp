// SPDX-License-Identifier: Apache-2.0
// The decoder with the records of the capture block: the same sweeps, to the tick, as from the recording itself.
#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <tuple>

#include "pharos/base/ticks.hpp"
#include "rtl/edges_player.hpp"
#include "unit/lighthouse/decoded.hpp"
#include "unit/lighthouse/recordings.hpp"

namespace pharos::rtl {
namespace {

constexpr std::int64_t kLength = 8 * kTicksPerSecond;

std::vector<lighthouse::Edge> edges_of(const std::vector<RecordWords>& records) {
  std::vector<lighthouse::Edge> edges;
  edges.reserve(records.size());
  TickUnwrapper unwrapper;
  for (const RecordWords& record : records) {
    const std::int64_t stamp = unwrapper.unwrap(record.time);
    for (std::uint32_t left = record.changed; left != 0; left &= left - 1) {
      const int sensor = std::countr_zero(left);
      edges.push_back({stamp, static_cast<std::uint8_t>(sensor), (record.levels >> sensor & 1) != 0});
    }
  }
  return edges;
}

// Pulses that end in one tick have an order in the recording and none in a record: hits are compared as a set, and the
// number of sensors that saw a flash, which can depend on that order, is left out.
bool same(const lighthouse::Sweep& a, const lighthouse::Sweep& b) {
  const auto flash = [](const lighthouse::Flash& f) {
    return std::tuple(f.start_ticks, f.length_ticks, f.station, f.axis, f.data, f.skip);
  };
  const auto hits = [](const lighthouse::Sweep& sweep) {
    std::set<std::tuple<int, int, int>> set;
    for (const auto& hit : sweep.hits) set.emplace(hit.sensor, hit.width_ticks, hit.centre_half_ticks);
    return set;
  };
  return flash(a.flash) == flash(b.flash) && a.period_sixteenth_ticks == b.period_sixteenth_ticks &&
         a.flags == b.flags && a.hits.size() == b.hits.size() && hits(a) == hits(b);
}

class CapturedSweeps : public testing::TestWithParam<const char*> {};

TEST_P(CapturedSweeps, AreThoseOfTheRecording) {
  PHAROS_NEEDS_RECORDINGS();
  auto pulses = test::recorded_pulses(GetParam());
  const std::int64_t end = pulses.front().rise_ticks + kLength;
  std::erase_if(pulses, [&](const lighthouse::RawPulse& pulse) { return pulse.rise_ticks >= end; });
  const PlayedEdges played = play_edges(pulses, {.service_ticks = 1'000});
  ASSERT_EQ(played.lost_edges, 0u);
  ASSERT_EQ(played.pulses_left_out, 0u);
  test::Decoded straight;
  straight.push(pulses);
  straight.flush();
  test::Decoded captured;
  captured.push(edges_of(played.records));
  captured.flush();
  ASSERT_GT(straight.sweeps.size(), 800u);
  ASSERT_EQ(captured.sweeps.size(), straight.sweeps.size());
  for (std::size_t i = 0; i < straight.sweeps.size(); ++i) {
    ASSERT_TRUE(same(captured.sweeps[i], straight.sweeps[i])) << "sweep " << i;
  }
  EXPECT_EQ(captured.payloads.size(), straight.payloads.size());
}

INSTANTIATE_TEST_SUITE_P(Recordings, CapturedSweeps, testing::Values("controller_quick", "two_bodies_controller"));

}  // namespace
}  // namespace pharos::rtl
