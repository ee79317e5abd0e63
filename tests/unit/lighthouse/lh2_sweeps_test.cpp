// SPDX-License-Identifier: Apache-2.0
// Light of Lighthouse 2.0 to sweeps and OOTX: syncs from beams alone, several stations, faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/lighthouse/lh2_ootx_fields.hpp"
#include "support/allocation_guard.hpp"
#include "support/lh2_light.hpp"
#include "support/synthetic_light.hpp"

namespace pharos::lighthouse {
namespace {

const Lh2Sequences& all_sequences() {
  static const Lh2Sequences kSequences;
  return kSequences;
}

struct Lh2Decoded {
  std::unique_ptr<Lh2LightDecoder> decoder = std::make_unique<Lh2LightDecoder>(all_sequences());
  std::vector<Lh2Sweep> sweeps;
  std::vector<OotxPayload> payloads;

  void take() {
    while (const auto sweep = decoder->take_sweep()) sweeps.push_back(*sweep);
    while (const auto payload = decoder->take_ootx()) payloads.push_back(*payload);
  }
  void push(std::vector<Lh2Edge> light) {
    std::stable_sort(light.begin(), light.end(),
                     [](const Lh2Edge& a, const Lh2Edge& b) { return a.time_ticks < b.time_ticks; });
    for (const Lh2Edge& edge : light) {
      decoder->push(edge);
      take();
    }
    decoder->flush();
    take();
    const Lh2Counters& c = decoder->counters();
    EXPECT_EQ(bursts_accounted(c), c.bursts);
    EXPECT_EQ(beams_accounted(c), c.beams);
  }
};

// A station on a target at rest: each sensor hit by both planes in each turn.
struct Lh2Scene {
  test::Lh2Station station;
  double turn_ticks;  // of the receiver's counter
  double begin_ticks = 4e6;
  std::vector<std::uint8_t> sensors = {0, 3, 7};

  double sync(int turn) const { return begin_ticks + turn_ticks * turn; }
  static std::size_t place(std::uint8_t sensor, int plane) {
    return 38'000U + 311U * sensor + static_cast<unsigned>(plane) * 39'000U;
  }

  void add(int turns, const std::vector<bool>& slow_bits, std::vector<Lh2Edge>& light, unsigned seed = 1) const {
    std::mt19937 random(seed);
    for (int turn = 0; turn < turns; ++turn) {
      const bool slow = !slow_bits.empty() && slow_bits[static_cast<std::size_t>(turn) % slow_bits.size()];
      for (int plane = 0; plane < 2; ++plane) {
        for (const std::uint8_t sensor : sensors) {
          station.pass(sync(turn), slow, place(sensor, plane), 48, sensor, light, random);
        }
      }
    }
  }
};

Lh2Scene channel_6(double clock = 1.0) {
  Lh2Scene scene{test::Lh2Station(0x12BD0, 0x1CF73, 100'000), 941'000.0 * 50.0 / 48.0 * clock};
  scene.station.bit_ticks *= clock;
  scene.station.jitter_ticks = 0.4;
  return scene;
}

Lh2Scene channel_0() { return {test::Lh2Station(0x1D258, 0x17E04, 100'000), 959'000.0 * 50.0 / 48.0}; }

std::vector<Lh2Edge> lh2_dark() {
  std::vector<Lh2Edge> light;
  for (std::uint8_t sensor = 0; sensor < 8; ++sensor) light.push_back({0, sensor, false, false});
  return light;
}

TEST(Lh2Sweeps, BothPlanesLeadToOneSyncWhateverTheStationsClock) {
  for (const double ppm : {-90.0, 0.0, 90.0}) {
    const Lh2Scene scene = channel_6(1.0 + 1e-6 * ppm);
    std::vector<Lh2Edge> light = lh2_dark();
    scene.add(30, {}, light);
    Lh2Decoded decoded;
    decoded.push(light);
    ASSERT_EQ(decoded.sweeps.size(), 60U) << ppm;
    for (std::size_t i = 0; i < decoded.sweeps.size(); ++i) {
      const Lh2Sweep& sweep = decoded.sweeps[i];
      EXPECT_EQ(sweep.channel, 6);
      EXPECT_EQ(sweep.plane, i % 2);
      ASSERT_EQ(sweep.hits.size(), 3U);
      for (const Lh2Hit& hit : sweep.hits) {
        const double bits = static_cast<double>(Lh2Scene::place(hit.sensor, sweep.plane)) + 24.0;
        EXPECT_NEAR(hit.centre_sixths / 50.0, bits, 0.25);  // 40 ns: rounding and jitter of the envelope
        const double angle = kTwoPi * bits / 117'625.0 - (sweep.plane + 1) * kTwoPi / 3;
        EXPECT_NEAR(lh2_hit_angle(sweep, hit), angle, 1.4e-5);
      }
      // The first beams come before the clocks' ratio is known: 90 ppm are 0.6 us at the first plane.
      const double tolerance_us = i < 4 ? 1.3 : 0.02;
      EXPECT_NEAR(static_cast<double>(sweep.sync_sixths) / 300.0, scene.sync(static_cast<int>(i) / 2) / 50.0,
                  tolerance_us);
    }
    EXPECT_EQ(decoded.decoder->counters().hits, 180U);
    EXPECT_EQ(decoded.decoder->counters().locks, 1U);
  }
}

TEST(Lh2Sweeps, SeparatesStationsWhoseLightMeets) {
  const Lh2Scene a = channel_6();
  const Lh2Scene b = channel_0();
  std::vector<Lh2Edge> light_a = lh2_dark(), light_b = lh2_dark();
  a.add(60, {}, light_a);
  b.add(60, {}, light_b, 2);
  // Light of both at once at one sensor: what a receiver gives for their sum is not known; here the later one wins.
  std::vector<Lh2Edge> light = light_a;
  light.insert(light.end(), light_b.begin(), light_b.end());
  Lh2Decoded decoded;
  decoded.push(light);
  std::map<int, std::size_t> hits;
  for (const Lh2Sweep& sweep : decoded.sweeps) {
    const Lh2Scene& scene = sweep.channel == 6 ? a : b;
    hits[sweep.channel] += sweep.hits.size();
    for (const Lh2Hit& hit : sweep.hits) {
      const double bits = static_cast<double>(Lh2Scene::place(hit.sensor, sweep.plane)) + 24.0;
      const double turn = (static_cast<double>(sweep.sync_sixths) / 6.0 - scene.begin_ticks) / scene.turn_ticks;
      EXPECT_NEAR(turn, std::round(turn), 1e-5);
      EXPECT_NEAR(hit.centre_sixths / 50.0, bits, 50.0);  // where they meet the envelope is that of both
    }
  }
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_GE(hits[6], 350U);
  EXPECT_GE(hits[0], 350U);
}

// Far away or at the edge of the field light lasts 4 us: too few bits to know a station by, enough to know it again.
TEST(Lh2Sweeps, ShortLightOfAKnownStationIsFound) {
  const Lh2Scene scene = channel_6();
  std::vector<Lh2Edge> light = lh2_dark();
  std::mt19937 random(1);
  for (int turn = 0; turn < 40; ++turn) {
    for (int plane = 0; plane < 2; ++plane) {
      const std::size_t place = Lh2Scene::place(3, plane);
      scene.station.pass(scene.sync(turn), false, place, 48, 3, light, random);
      if (turn > 3) scene.station.pass(scene.sync(turn), false, place + 300, 21, 7, light, random);
    }
  }
  Lh2Decoded decoded;
  decoded.push(light);
  EXPECT_GE(decoded.decoder->counters().hits, 80U + 68U);
  // Alone it is nobody's.
  light = lh2_dark();
  for (int turn = 0; turn < 40; ++turn) {
    scene.station.pass(scene.sync(turn), false, Lh2Scene::place(7, 0), 21, 7, light, random);
  }
  Lh2Decoded alone;
  alone.push(light);
  EXPECT_EQ(alone.decoder->counters().hits, 0U);
}

TEST(Lh2Sweeps, OneBeamAloneIsNoStation) {
  const Lh2Scene scene = channel_6();
  std::vector<Lh2Edge> light = lh2_dark();
  std::mt19937 random(1);
  scene.station.pass(scene.sync(0), false, 40'000, 48, 3, light, random);
  // And one of a sync that has nothing to do with it.
  scene.station.pass(scene.sync(0) + 7777.0, false, 60'000, 48, 3, light, random);
  Lh2Decoded decoded;
  decoded.push(light);
  EXPECT_TRUE(decoded.sweeps.empty());
  EXPECT_EQ(decoded.decoder->counters().beams_unconfirmed, 2U);
}

TEST(Lh2Sweeps, FindsARestartedStationAndOneAfterDarkness) {
  Lh2Scene scene = channel_6();
  std::vector<Lh2Edge> light = lh2_dark();
  scene.add(10, {}, light);
  scene.begin_ticks += 10.37 * scene.turn_ticks;  // another phase
  scene.add(10, {}, light);
  scene.begin_ticks += 3.01e8;  // six seconds of darkness
  scene.add(10, {}, light);
  Lh2Decoded decoded;
  decoded.push(light);
  EXPECT_EQ(decoded.decoder->counters().locks, 3U);
  // A restarted station is believed once the old rotor was not confirmed for three turns: 18 hits at the most.
  EXPECT_GE(decoded.decoder->counters().hits, 180U - 18U);
}

TEST(Lh2Sweeps, SlowBitsCarryTheStationsCalibration) {
  // As a real station sent it (libsurvive's recording of FE0398EF).
  const std::string hex = "8808ef9803fe0000559e46aadb29010f94359730007ffca63f7440e39c599c88003042d735412fbeb27c06";
  std::vector<std::uint8_t> payload;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    payload.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  const auto bits = test::ootx_bits(payload);
  Lh2Scene scene = channel_6();
  scene.sensors = {3};
  std::vector<Lh2Edge> light = lh2_dark();
  const std::vector<bool> slow(bits.begin(), bits.end());
  scene.add(static_cast<int>(slow.size()) + 2, slow, light);
  Lh2Decoded decoded;
  decoded.push(light);
  ASSERT_EQ(decoded.payloads.size(), 1U);
  EXPECT_EQ(decoded.payloads[0].station, 6);
  const auto& bytes = decoded.payloads[0].bytes;
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), payload.begin(), payload.end()));
  const auto fields = lh2_ootx_fields({bytes.data(), bytes.size()});
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->calibration.id, 4261648623U);
  EXPECT_EQ(fields->mode & 0xF, 8);
  const PlaneCalibration a{0.0, -0.049011230469, 0.348632812500, 1.912109375, -0.004772186279, 3.09375, 0.113342285156};
  const PlaneCalibration b{-0.006183624268, 0.045745849609, 0.143432617188, 2.2265625,
                           -0.004245758057, 0.364990234375, -0.210693359375};
  for (const auto field : {&PlaneCalibration::phase_rad, &PlaneCalibration::tilt_rad, &PlaneCalibration::curve,
                           &PlaneCalibration::gibbous_phase_rad, &PlaneCalibration::gibbous_magnitude_rad,
                           &PlaneCalibration::ogee_phase_rad, &PlaneCalibration::ogee_magnitude}) {
    EXPECT_NEAR(fields->calibration.plane[0].*field, a.*field, 1e-11);
    EXPECT_NEAR(fields->calibration.plane[1].*field, b.*field, 1e-11);
  }
}

TEST(Lh2Ootx, RefusesPayloadsOfOthersAndValuesThatAreNone) {
  std::vector<std::uint8_t> payload(43, 0);
  payload[0] = 6;
  EXPECT_EQ(lh2_ootx_fields(payload).error(), OotxError::kUnknownProtocol);
  payload[0] = 8;
  EXPECT_TRUE(lh2_ootx_fields(payload).ok());
  payload[0x26] = 0x7C;  // an infinite half
  EXPECT_EQ(lh2_ootx_fields(payload).error(), OotxError::kNotFinite);
  EXPECT_EQ(lh2_ootx_fields(std::vector<std::uint8_t>{8, 0, 1}).error(), OotxError::kTooShort);
}

TEST(Lh2Sweeps, NoHeap) {
  const Lh2Scene scene = channel_6();
  std::vector<Lh2Edge> light = lh2_dark();
  scene.add(5, {}, light);
  const auto decoder = std::make_unique<Lh2LightDecoder>(all_sequences());
  const test::AllocationGuard guard;
  std::size_t sweeps = 0;
  for (const Lh2Edge& edge : light) {
    decoder->push(edge);
    while (decoder->take_sweep()) ++sweeps;
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_GE(sweeps, 8U);
}

}  // namespace
}  // namespace pharos::lighthouse
