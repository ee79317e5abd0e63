// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/bearing.hpp"
#include "unit/lighthouse/decoded.hpp"

namespace pharos::lighthouse {
namespace {

using test::Decoded;
using test::SyntheticLight;

constexpr std::int64_t kSecond = 50'000'000;

std::vector<Edge> edges_of(const std::vector<RawPulse>& light) {
  std::vector<Edge> edges;
  for (const RawPulse& pulse : light) {
    edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    edges.push_back({pulse.fall_ticks, pulse.sensor, false});
  }
  std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  return edges;
}

void expect_same(const std::vector<Sweep>& a, const std::vector<Sweep>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].flash.start_ticks, b[i].flash.start_ticks);
    ASSERT_EQ(a[i].hits.size(), b[i].hits.size());
    for (std::size_t j = 0; j < a[i].hits.size(); ++j) {
      EXPECT_EQ(a[i].hits[j].sensor, b[i].hits[j].sensor);
      EXPECT_EQ(a[i].hits[j].centre_half_ticks, b[i].hits[j].centre_half_ticks);
    }
  }
}

TEST(Decoder, FindsBothStationsOfTwoAndEveryHitToTheTick) {
  const SyntheticLight light({});
  Decoded decoded;
  decoded.push(light.slots(0, 120));
  decoded.flush();
  const std::size_t lit = test::expect_truth(decoded.sweeps, light, 120);
  // Twelve flashes are six slots; one sweep a slot from there on.
  EXPECT_GE(lit, 120U - 6U);
  EXPECT_EQ(decoded.counters().hits, lit * 4);
  EXPECT_EQ(decoded.counters().locks, 1U);
  EXPECT_EQ(decoded.counters().locks_lost, 0U);
  EXPECT_EQ(decoded.counters().flashes_missed, 0U);
  EXPECT_EQ(decoded.counters().flashes_rejected, 0U);
  EXPECT_EQ(decoded.counters().flashes + decoded.counters().flashes_before_lock, 240U);
  EXPECT_LT(decoded.counters().flashes_before_lock, 12U);
  EXPECT_EQ(decoded.counters().pulses_in_flashes, 4 * decoded.counters().flashes);
  EXPECT_EQ(decoded.counters().pulses_flash_length, 4 * decoded.counters().flashes_before_lock);
  EXPECT_EQ(decoded.counters().time_base_changes, 1U);
  test::expect_balance(decoded.counters());
}

TEST(Decoder, FindsALoneStationThatNeverSkips) {
  SyntheticLight::Settings settings;
  settings.layout = SyntheticLight::Layout::kLoneA;
  const SyntheticLight light(settings);
  Decoded decoded;
  decoded.push(light.slots(0, 120));
  decoded.flush();
  EXPECT_GE(test::expect_truth(decoded.sweeps, light, 120), 120U - 12U);
  for (const Sweep& sweep : decoded.sweeps) {
    EXPECT_EQ(sweep.flash.station, 0);
    EXPECT_FALSE(sweep.flash.skip);
  }
  test::expect_balance(decoded.counters());
}

TEST(Decoder, LocksWithinTwelveFlashesWhereverTheCycleStands) {
  for (const auto layout : {SyntheticLight::Layout::kLoneA, SyntheticLight::Layout::kTwo}) {
    SyntheticLight::Settings settings;
    settings.layout = layout;
    const SyntheticLight light(settings);
    for (std::int64_t first = 0; first < 16; ++first) {
      Decoded decoded;
      const std::int64_t slots = 12 / light.stations();
      decoded.push(light.slots(first, first + slots));
      EXPECT_FALSE(decoded.decoder.lock().locked && decoded.counters().flashes == 0);
      decoded.push(light.slots(first + slots, first + slots + 1));
      EXPECT_TRUE(decoded.decoder.lock().locked) << "first slot " << first;
    }
  }
}

TEST(Decoder, ThetaIsTheFractionOfATurn) {
  const SyntheticLight light({});
  Decoded decoded;
  decoded.push(light.slots(0, 200));
  decoded.flush();
  const double tick_rad = kTwoPi / light.settings().turn_ticks;
  for (std::size_t i = 20; i < decoded.sweeps.size(); ++i) {
    const Sweep& sweep = decoded.sweeps[i];
    for (const Bearing& bearing : bearings_of(sweep)) {
      const int axis = index_of(sweep.flash.axis);
      const double expected_rad = kTwoPi * SyntheticLight::fraction(sweep.flash.station, axis, bearing.sensor);
      EXPECT_NEAR(bearing.theta_rad, expected_rad, 1.5 * tick_rad);
      EXPECT_EQ(bearing.width_ticks, SyntheticLight::hit_width(bearing.sensor));
    }
  }
}

TEST(Decoder, GivesASweepWithTheNextSlotsFirstPulses) {
  const SyntheticLight light({});
  Decoded decoded;
  decoded.push(light.slots(0, 20));
  const std::size_t before = decoded.lit();
  std::vector<RawPulse> next;
  light.add_flash(light.flash(0, 20), next);
  decoded.push(next);
  EXPECT_EQ(decoded.lit(), before + 1);
}

TEST(Decoder, GivesASweepAsSoonAsTheClockSaysThatItsWindowHasPassed) {
  const SyntheticLight light({});
  Decoded decoded;
  decoded.push(light.slots(0, 20));
  const std::size_t before = decoded.lit();
  const std::int64_t flash = light.flash(0, 19).start_ticks + light.flash(1, 19).start_ticks;
  decoded.decoder.advance(flash / 2 + 300'000);  // 6 ms after the flashes: hits are still possible
  decoded.take();
  EXPECT_EQ(decoded.lit(), before);
  decoded.decoder.advance(flash / 2 + 380'000);  // 7.6 ms
  decoded.take();
  EXPECT_EQ(decoded.lit(), before + 1);
}

TEST(Decoder, IgnoresAClockOfAnotherTime) {
  const SyntheticLight light({});
  Decoded decoded;
  decoded.decoder.advance(0);
  decoded.push(light.slots(0, 20));
  decoded.decoder.advance(100 * kSecond);
  decoded.decoder.advance(INT64_MAX);
  decoded.decoder.advance(INT64_MIN);
  decoded.push(light.slots(20, 40));
  decoded.flush();
  EXPECT_GE(test::expect_truth(decoded.sweeps, light, 40), 34U);
}

TEST(Decoder, EdgesGiveTheSameAsPulses) {
  const SyntheticLight light({});
  const auto pulses = light.slots(0, 100);
  Decoded from_pulses;
  from_pulses.push(pulses);
  from_pulses.flush();
  Decoded from_edges;
  from_edges.push(edges_of(pulses));
  from_edges.flush();
  expect_same(from_pulses.sweeps, from_edges.sweeps);
  EXPECT_EQ(from_edges.counters().edges_in, 2 * pulses.size());
  EXPECT_EQ(from_edges.counters().edges_in, edges_accounted(from_edges.counters()));
  test::expect_balance(from_edges.counters());
}

TEST(Decoder, AnyOrderWithin200MicrosecondsGivesTheSame) {
  const SyntheticLight light({});
  const auto pulses = light.slots(0, 100);
  Decoded in_order;
  in_order.push(pulses);
  in_order.flush();
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> late(0, 10'000);
  // Late by up to 200 us, in the order of the falls and in that of the rises; and edges.
  for (const bool at_rise : {false, true}) {
    std::vector<std::pair<std::int64_t, RawPulse>> arrivals;
    for (const RawPulse& pulse : pulses) {
      arrivals.emplace_back((at_rise ? pulse.rise_ticks : pulse.fall_ticks) + late(random), pulse);
    }
    std::stable_sort(arrivals.begin(), arrivals.end(), [](auto& a, auto& b) { return a.first < b.first; });
    Decoded shuffled;
    for (const auto& [when, pulse] : arrivals) shuffled.push(std::vector<RawPulse>{pulse});
    shuffled.flush();
    expect_same(in_order.sweeps, shuffled.sweeps);
    EXPECT_EQ(shuffled.counters().pulses_late, 0U);
  }
  std::vector<std::pair<std::int64_t, Edge>> arrivals;
  for (const Edge& edge : edges_of(pulses)) arrivals.emplace_back(edge.stamp_ticks + late(random), edge);
  std::stable_sort(arrivals.begin(), arrivals.end(), [](auto& a, auto& b) { return a.first < b.first; });
  Decoded shuffled;
  for (const auto& [when, edge] : arrivals) shuffled.push(std::vector<Edge>{edge});
  shuffled.flush();
  expect_same(in_order.sweeps, shuffled.sweeps);
}

TEST(Decoder, KeepsEveryHitOfASensor) {
  const SyntheticLight light({});
  auto pulses = light.slots(0, 60);
  std::size_t reflections = 0;
  for (std::int64_t slot = 10; slot < 50; ++slot) {
    for (int station = 0; station < 2; ++station) {
      const auto truth = light.flash(station, slot);
      if (truth.skip) continue;
      const std::int64_t centre = truth.start_ticks + light.centre_after_flash(truth, 3) + 902;
      pulses.push_back({centre - 70, centre + 70, 3});
      ++reflections;
    }
  }
  SyntheticLight::sort_by_fall(pulses);
  Decoded decoded;
  decoded.push(pulses);
  decoded.flush();
  std::size_t doubles = 0;
  for (const Sweep& sweep : decoded.sweeps) {
    const auto of_sensor = [](const Hit& hit) { return hit.sensor == 3; };
    doubles += std::count_if(sweep.hits.begin(), sweep.hits.end(), of_sensor) == 2;
  }
  EXPECT_EQ(doubles, reflections);
}

TEST(Decoder, ReadsPayloadsOfBothStations) {
  const auto first = test::from_hex("063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100");
  const auto second = test::from_hex("063de14d3bc3002beb2b2e9dea202b09f89c39a0007f04f3ad48ba30a1b9a00200");
  const std::vector<bool> bits[2] = {test::ootx_bits(first), test::ootx_bits(second)};
  SyntheticLight::Settings settings;
  settings.bit = [&](int station, long n) {
    const auto& frame = bits[station];
    return static_cast<bool>(frame[static_cast<std::size_t>(n + 100 * station) % frame.size()]);
  };
  const SyntheticLight light(settings);
  Decoded decoded;
  decoded.push(light.slots(0, 3 * 358));
  decoded.flush();
  std::size_t count[2] = {0, 0};
  for (const OotxPayload& payload : decoded.payloads) {
    const auto& expected = payload.station == 0 ? first : second;
    EXPECT_TRUE(std::equal(payload.bytes.begin(), payload.bytes.end(), expected.begin(), expected.end()));
    ++count[payload.station];
  }
  EXPECT_EQ(count[0], 2U);
  EXPECT_GE(count[1], 2U);
  EXPECT_EQ(decoded.counters().ootx_frames, count[0] + count[1]);
  EXPECT_EQ(decoded.counters().ootx_bad_crc, 0U);
}

TEST(Decoder, FitsTheSoftCore) { EXPECT_LT(sizeof(Decoder), 16U * 1024U); }

TEST(Decoder, SaysWhenNobodyTakesWhatItGives) {
  const SyntheticLight light({});
  Decoder decoder;
  for (const RawPulse& pulse : light.slots(0, 60)) decoder.push(pulse);
  EXPECT_GT(decoder.counters().outputs_overflow, 0U);
  EXPECT_EQ(decoder.counters().sweeps, SweepCollector::kHeld);
}

}  // namespace
}  // namespace pharos::lighthouse
