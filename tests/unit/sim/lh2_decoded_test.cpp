// SPDX-License-Identifier: Apache-2.0
// The decoder of Lighthouse 2.0 on simulated light, against its truth: what is found, and what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/lighthouse/lh2_ootx_fields.hpp"
#include "tests/unit/sim/lh2_scene.hpp"
#include "tools/sim/lh2/lh2_simulator.hpp"

namespace pharos::sim {
namespace {

struct Comparison {
  std::size_t passes = 0, found = 0, reflections = 0, reflections_found = 0;
  std::size_t without_truth = 0;
  std::vector<double> angle_arcsec, sync_us;
  std::vector<lighthouse::OotxPayload> payloads;
  lighthouse::Lh2Counters counters;

  static double at(std::vector<double> values, double fraction) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
  }
};

constexpr double kSame_s = 3e-6;  // a third of the light's length

Comparison decode(const LighthouseScenario& scenario, std::uint64_t seed = 7) {
  Lh2Simulator simulator(scenario, seed);
  static const lighthouse::Lh2Sequences kSequences;
  const auto decoder = std::make_unique<lighthouse::Lh2LightDecoder>(kSequences);
  std::vector<lighthouse::Lh2Sweep> sweeps;
  Comparison out;
  const auto take = [&] {
    while (const auto sweep = decoder->take_sweep()) sweeps.push_back(*sweep);
    while (const auto payload = decoder->take_ootx()) out.payloads.push_back(*payload);
  };
  while (const auto change = simulator.next()) {
    decoder->push({change->time_ticks, change->sensor, change->data, !change->envelope});
    take();
  }
  decoder->flush();
  take();
  out.counters = decoder->counters();
  EXPECT_EQ(bursts_accounted(out.counters), out.counters.bursts);
  EXPECT_EQ(beams_accounted(out.counters), out.counters.beams);
  // Truth by channel, plane and sensor, in the order of time.
  std::map<std::tuple<int, int, int>, std::map<double, LightPass>> truth;
  for (const LightPass& pass : simulator.passes()) {
    const int channel = simulator.stations()[static_cast<std::size_t>(pass.station)].channel;
    truth[{channel, pass.plane, pass.sensor}][pass.time_s] = pass;
    ++(pass.reflection ? out.reflections : out.passes);
  }
  for (const lighthouse::Lh2Sweep& sweep : sweeps) {
    for (const lighthouse::Lh2Hit& hit : sweep.hits) {
      const double time_s = lh2_hit_time(sweep, hit);
      const auto& passes = truth[{sweep.channel, sweep.plane, hit.sensor}];
      auto near = passes.lower_bound(time_s - kSame_s);
      if (near == passes.end() || near->first > time_s + kSame_s) {
        ++out.without_truth;
        continue;
      }
      const LightPass& pass = near->second;
      ++(pass.reflection ? out.reflections_found : out.found);
      const double angle = pass.turned_rad - (pass.plane + 1) * kTwoPi / 3;
      out.angle_arcsec.push_back(std::abs(lh2_hit_angle(sweep, hit) - angle) / kRadPerArcsec);
      out.sync_us.push_back(std::abs(static_cast<double>(sweep.sync_sixths) / 300.0 - pass.sync_s * 1e6));
    }
  }
  return out;
}

TEST(Lh2Decoded, OneStationsCleanLightIsFoundWhole) {
  const Comparison c = decode(lh2_scene(1.0));
  EXPECT_GE(c.found + 1, c.passes);  // the light at the very end may be cut
  EXPECT_EQ(c.without_truth, 0U);
  EXPECT_LT(Comparison::at(c.angle_arcsec, 1.0), 2.0);  // envelopes rounded to ticks: 0.1 us are 6.7 arcsec
  EXPECT_LT(Comparison::at(c.sync_us, 0.95), 0.02);
}

TEST(Lh2Decoded, TwoStationsAtOnceCostOnlyWhatMeets) {
  const Comparison c = decode(lh2_scene(3.0, 2));
  EXPECT_GE(c.found, c.passes * 99 / 100);
  EXPECT_LE(c.without_truth, c.passes / 500);
  EXPECT_LT(Comparison::at(c.angle_arcsec, 0.99), 3.0);
  EXPECT_EQ(c.counters.locks, 2U);
}

TEST(Lh2Decoded, NoisePulsesAndLostChangesCostFew) {
  LighthouseScenario scenario = lh2_scene(2.0, 2);
  scenario.faults.glitches_per_s = 400;
  scenario.faults.lost_edge_rate = 0.01;
  scenario.noise.bit_jitter_ns = 12;
  const Comparison c = decode(scenario);
  EXPECT_GE(c.found, c.passes * 95 / 100);
  EXPECT_LE(c.without_truth, c.passes / 500);
  EXPECT_GT(c.counters.bursts_short, 500U);
  EXPECT_EQ(c.counters.locks, 2U);
  std::printf("noise: %zu of %zu passes found, %zu without truth\n", c.found, c.passes, c.without_truth);
}

// A part of the light gives a hit where its middle was, which is not where the plane's was: found, and up to 3 us off.
TEST(Lh2Decoded, CutBurstsAreStillTheirStations) {
  LighthouseScenario scenario = lh2_scene(2.0);
  scenario.faults.cut_burst_rate = 0.3;
  const Comparison c = decode(scenario);
  EXPECT_GE(c.found + c.without_truth, c.passes * 93 / 100);
  EXPECT_EQ(c.counters.locks, 1U);
  EXPECT_LT(Comparison::at(c.angle_arcsec, 0.6), 2.0);  // those that were not cut
  EXPECT_LT(Comparison::at(c.sync_us, 0.95), 0.05);
  std::printf("cut: %zu of %zu passes found, %zu further off\n", c.found, c.passes, c.without_truth);
}

TEST(Lh2Decoded, ReflectionsAreHitsOfTheSameSync) {
  LighthouseScenario scenario = lh2_scene(1.0);
  scenario.faults.reflections.push_back({0, Rotor::kX, {2, 5}, 0.0, 1e9, 4000.0, 0.7});
  const Comparison c = decode(scenario);
  EXPECT_GT(c.reflections, 80U);
  EXPECT_GE(c.reflections_found, c.reflections * 97 / 100);
  EXPECT_GE(c.found, c.passes * 99 / 100);
  EXPECT_EQ(c.without_truth, 0U);
}

TEST(Lh2Decoded, StationsTellTheirCalibration) {
  LighthouseScenario scenario = lh2_scene(19.0);  // a frame of 443 bits lasts 8.7 s
  scenario.target.resize(1);
  Lh2Simulator simulator(scenario, 7);
  const Comparison c = decode(scenario);
  ASSERT_GE(c.payloads.size(), 1U);
  const auto& payload = c.payloads[0];
  EXPECT_EQ(payload.station, 6);
  const auto fields = lighthouse::lh2_ootx_fields({payload.bytes.data(), payload.bytes.size()});
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->calibration.id, simulator.stations()[0].id);
  EXPECT_EQ(fields->mode & 0xF, 6);
  for (std::size_t k = 0; k < 2; ++k) {
    const PlaneErrors& e = simulator.stations()[0].announced[k];
    EXPECT_EQ(fields->calibration.plane[k].tilt_rad, e.tilt_rad);
    EXPECT_EQ(fields->calibration.plane[k].ogee_magnitude, e.ogee_magnitude);
    EXPECT_EQ(fields->calibration.plane[k].gibbous_phase_rad, e.gibbous_phase_rad);
  }
}

}  // namespace
}  // namespace pharos::sim
