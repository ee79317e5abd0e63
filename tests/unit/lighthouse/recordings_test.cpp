// SPDX-License-Identifier: Apache-2.0
// The decoder with real light. Expected results are listed with the recordings or were decoded from them by another
// program; the figures are the noise and completeness on stationary targets.
#include "unit/lighthouse/recordings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/ootx_fields.hpp"
#include "unit/lighthouse/decoded.hpp"

namespace pharos::lighthouse {
namespace {

using test::Decoded;

struct Listed {
  const char* recording;
  std::map<std::string, std::size_t> payloads;  // hex, times at least
};

// Identity and calibration of each payload, which must not differ between recordings.
const char* const kBEC08E38 = "063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100";
const char* const kC33B4DE1 = "063de14d3bc3002beb2b2e9dea202b09f89c39a0007f04f3ad48ba30a1b9a00200";
const char* const kF77E21F3 = "066df3217ef7d9257327d7a005a00209bd1835180a7f073e3fb5bc472549a20100";
const char* const k0AA54F65 = "066d654fa50a812bf52b801533050409d397669b007f02c8412526d81c1d9c0000";

const std::array<Listed, 4> kListed = {{{"hmd_static", {{kBEC08E38, 5}, {kC33B4DE1, 5}}},
                                        {"controller_quick", {{kBEC08E38, 16}, {kC33B4DE1, 16}}},
                                        {"two_bodies_hmd", {{kF77E21F3, 4}, {k0AA54F65, 4}}},
                                        {"two_bodies_controller", {{kF77E21F3, 3}, {k0AA54F65, 5}}}}};

Decoded decode(const std::string& name) {
  Decoded decoded;
  decoded.push(test::recorded_pulses(name));
  decoded.flush();
  return decoded;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double deviation(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  double square = 0.0;
  for (const double value : values) square += (value - mean) * (value - mean) / static_cast<double>(values.size());
  return std::sqrt(square);
}

struct Noise {
  double raw_arcsec = 0.0;
  double smoothed_arcsec = 0.0;
  std::size_t series = 0;
};

/// Standard deviation of theta over the whole recording, one sweep, median over sensors and rotors. Nothing is removed
/// except hits more than 200 arcsec from their series' median (reflections) and series seen in less than half of the
/// sweeps.
Noise still_noise(const std::vector<Sweep>& sweeps) {
  struct Series {
    std::vector<double> raw, smoothed;
  };
  std::map<std::tuple<int, int, int>, Series> series;
  std::map<std::pair<int, int>, std::size_t> lit;
  std::map<std::pair<int, int>, FlashSmoother> smoothers;
  for (const Sweep& sweep : sweeps) {
    const std::pair<int, int> rotor{sweep.flash.station, index_of(sweep.flash.axis)};
    const SmoothedFlash smoothed = smoothers[rotor].push(sweep);
    if (sweep.flash.skip) continue;
    ++lit[rotor];
    const SweepBearings raw = bearings_of(sweep);
    const SweepBearings better = bearings_of(sweep, smoothed);
    for (std::size_t i = 0; i < raw.size(); ++i) {
      Series& of_sensor = series[{rotor.first, rotor.second, raw[i].sensor}];
      of_sensor.raw.push_back(raw[i].theta_rad * kArcsecPerRad);
      of_sensor.smoothed.push_back(better[i].theta_rad * kArcsecPerRad);
    }
  }
  std::vector<double> raw;
  std::vector<double> smoothed;
  for (auto& [key, values] : series) {
    if (values.raw.size() * 2 < lit[{std::get<0>(key), std::get<1>(key)}]) continue;
    const double centre = median(values.raw);
    std::vector<double> kept_raw;
    std::vector<double> kept_smoothed;
    for (std::size_t i = 0; i < values.raw.size(); ++i) {
      if (std::abs(values.raw[i] - centre) > 200.0) continue;
      kept_raw.push_back(values.raw[i]);
      kept_smoothed.push_back(values.smoothed[i]);
    }
    raw.push_back(deviation(kept_raw));
    smoothed.push_back(deviation(kept_smoothed));
  }
  return {median(raw), median(smoothed), raw.size()};
}

TEST(Recordings, GiveEveryListedPayloadAndNoOther) {
  PHAROS_NEEDS_RECORDINGS();
  for (const Listed& listed : kListed) {
    const Decoded decoded = decode(listed.recording);
    std::map<std::uint32_t, std::size_t> count;
    for (const OotxPayload& payload : decoded.payloads) {
      const auto fields = ootx_fields({payload.bytes.data(), payload.bytes.size()});
      ASSERT_TRUE(fields) << listed.recording;
      bool known = false;
      for (const auto& [hex, times] : listed.payloads) {
        known = known || ootx_fields(test::from_hex(hex.c_str()))->calibration == fields->calibration;
      }
      EXPECT_TRUE(known) << listed.recording << ": a payload of id " << std::hex << fields->calibration.id;
      ++count[fields->calibration.id];
    }
    for (const auto& [hex, times] : listed.payloads) {
      const std::uint32_t id = ootx_fields(test::from_hex(hex.c_str()))->calibration.id;
      EXPECT_GE(count[id], times) << listed.recording << " " << std::hex << id;
    }
    EXPECT_EQ(decoded.counters().ootx_bad_crc, 0U) << listed.recording;
    test::expect_balance(decoded.counters());
  }
}

TEST(Recordings, FirstAngleComesWithin150Milliseconds) {
  PHAROS_NEEDS_RECORDINGS();
  for (const Listed& listed : kListed) {
    const auto pulses = test::recorded_pulses(listed.recording);
    // From the first good flash (sync length, not one of the stale pulses); there is no angle before the first hit.
    std::int64_t first_flash = -1;
    std::int64_t first_hit = -1;
    Decoded decoded;
    std::int64_t now = 0;
    std::int64_t lit = -1;
    for (const RawPulse& pulse : pulses) {
      const std::int64_t width = pulse.fall_ticks - pulse.rise_ticks;
      const bool stale = width > 10'000;
      if (!stale) now = pulse.fall_ticks;
      if (!stale && width > 2'900 && first_flash < 0) first_flash = pulse.rise_ticks;
      if (width < 1'000 && first_flash >= 0 && first_hit < 0) first_hit = pulse.rise_ticks;
      decoded.push(std::vector<RawPulse>{pulse});
      if (lit < 0 && decoded.lit() > 0) lit = now;
      const auto has_angle = [](const Sweep& sweep) { return !sweep.hits.empty(); };
      if (std::any_of(decoded.sweeps.begin(), decoded.sweeps.end(), has_angle)) break;
    }
    const double sweep_s = static_cast<double>(lit - first_flash) / 50e6;
    const double angle_s = static_cast<double>(now - std::max(first_flash, first_hit)) / 50e6;
    EXPECT_LE(sweep_s, 0.15) << listed.recording;
    EXPECT_LE(angle_s, 0.15) << listed.recording;
    EXPECT_GT(sweep_s, 0.0);
    std::printf(
        "%-22s first flash at %.3f s, first hit at %.3f s, first sweep after %.3f s, first angle after %.3f s\n",
        listed.recording, static_cast<double>(first_flash) / 50e6, static_cast<double>(first_hit) / 50e6, sweep_s,
        angle_s);
  }
}

TEST(Recordings, AStationarySensorHasTheStatedNoise) {
  PHAROS_NEEDS_RECORDINGS();
  const std::map<std::string, double> limit_arcsec = {
      {"hmd_static", 9.2}, {"two_bodies_controller", 6.3}, {"two_bodies_hmd", 9.2}};
  for (const auto& [name, limit] : limit_arcsec) {
    const Noise noise = still_noise(decode(name).sweeps);
    std::printf("%-22s still sensor, one sweep: raw %.2f arcsec, smoothed %.2f (%.2f), %zu series\n", name.c_str(),
                noise.raw_arcsec, noise.smoothed_arcsec, noise.smoothed_arcsec / noise.raw_arcsec, noise.series);
    EXPECT_LE(noise.raw_arcsec, limit) << name;
    EXPECT_LE(noise.smoothed_arcsec, 0.85 * noise.raw_arcsec) << name;
    EXPECT_GE(noise.series, 20U) << name;
  }
}

TEST(Recordings, SmoothingDoesNotHurtInMotion) {
  PHAROS_NEEDS_RECORDINGS();
  // Third differences of a sensor's angle over consecutive sweeps: they are small for the smooth motion of a hand.
  std::map<std::tuple<int, int, int>, std::vector<std::array<double, 3>>> series;
  std::map<std::pair<int, int>, FlashSmoother> smoothers;
  for (const Sweep& sweep : decode("controller_quick").sweeps) {
    const std::pair<int, int> rotor{sweep.flash.station, index_of(sweep.flash.axis)};
    const SmoothedFlash smoothed = smoothers[rotor].push(sweep);
    const SweepBearings raw = bearings_of(sweep);
    const SweepBearings better = bearings_of(sweep, smoothed);
    for (std::size_t i = 0; i < raw.size(); ++i) {
      series[{rotor.first, rotor.second, raw[i].sensor}].push_back(
          {static_cast<double>(raw[i].time_ticks), raw[i].theta_rad, better[i].theta_rad});
    }
  }
  std::vector<double> raw;
  std::vector<double> smoothed;
  for (const auto& of_sensor : series) {
    const auto& values = of_sensor.second;  // a binding cannot be captured below (clang 14)
    for (std::size_t i = 3; i < values.size(); ++i) {
      if (values[i][0] - values[i - 3][0] > 3.2 * 2 * kNominalPeriod_ticks) continue;
      const auto third = [&](std::size_t k) {
        return std::abs(values[i][k] - 3 * values[i - 1][k] + 3 * values[i - 2][k] - values[i - 3][k]);
      };
      raw.push_back(third(1));
      smoothed.push_back(third(2));
    }
  }
  ASSERT_GT(raw.size(), 5000U);
  EXPECT_LT(median(smoothed), median(raw));
}

TEST(Recordings, EdgesAndAnyOrderGiveWhatPulsesGive) {
  PHAROS_NEEDS_RECORDINGS();
  for (const Listed& listed : kListed) {
    const auto pulses = test::recorded_pulses(listed.recording);
    const Decoded expected = decode(listed.recording);
    Decoded from_edges;
    std::mt19937 random(1);
    std::uniform_int_distribution<std::int64_t> late(0, 10'000);
    std::vector<std::pair<std::int64_t, RawPulse>> arrivals;
    for (const RawPulse& pulse : pulses) {
      arrivals.emplace_back(pulse.fall_ticks + late(random), pulse);
      from_edges.push(
          std::vector<Edge>{{pulse.rise_ticks, pulse.sensor, true}, {pulse.fall_ticks, pulse.sensor, false}});
    }
    from_edges.flush();
    Decoded shuffled;
    std::stable_sort(arrivals.begin() + 15, arrivals.end(), [](auto& a, auto& b) { return a.first < b.first; });
    for (const auto& arrival : arrivals) shuffled.push(std::vector<RawPulse>{arrival.second});
    shuffled.flush();
    ASSERT_EQ(shuffled.sweeps.size(), expected.sweeps.size()) << listed.recording;
    ASSERT_EQ(from_edges.sweeps.size(), expected.sweeps.size()) << listed.recording;
    for (std::size_t i = 0; i < expected.sweeps.size(); ++i) {
      ASSERT_EQ(shuffled.sweeps[i].flash.start_ticks, expected.sweeps[i].flash.start_ticks);
      ASSERT_EQ(shuffled.sweeps[i].hits.size(), expected.sweeps[i].hits.size());
      ASSERT_EQ(from_edges.sweeps[i].flash.start_ticks, expected.sweeps[i].flash.start_ticks);
      ASSERT_EQ(from_edges.sweeps[i].hits.size(), expected.sweeps[i].hits.size());
    }
  }
}

struct PeerAngle {
  int sensor = 0;
  int axis = 0;
  int station = 0;
  std::int64_t timecode48 = 0;  // unwrapped
  double angle_rad = 0.0;
};

std::vector<PeerAngle> peer_angles() {
  host::ByteSource source((test::recordings() / "two_bodies_hmd.peer_angles.csv.gz").string());
  std::string text;
  std::array<char, 65536> buffer{};
  while (const std::size_t count = source.read(buffer)) text.append(buffer.data(), count);
  std::vector<PeerAngle> angles;
  TickUnwrapper unwrapper;
  std::size_t at = text.find('\n') + 1;
  while (at < text.size()) {
    PeerAngle angle;
    int code = 0;
    std::uint32_t timecode = 0;
    if (std::sscanf(text.c_str() + at, "%*[^,],%*[^,],%d,%d,%u,%*[^,],%lf,%d", &angle.sensor, &code, &timecode,
                    &angle.angle_rad, &angle.station) == 5) {
      angle.axis = code & 1;
      angle.timecode48 = unwrapper.unwrap(timecode);
      angles.push_back(angle);
    }
    at = text.find('\n', at) + 1;
    if (at == 0) break;
  }
  return angles;
}

TEST(Recordings, AgreeWithAnotherDecoderToArcSeconds) {
  PHAROS_NEEDS_RECORDINGS();
  const std::vector<PeerAngle> peers = peer_angles();
  ASSERT_GT(peers.size(), 20'000U);
  // Both programs processed the same pulses: the peer's time codes are these ticks at 48 MHz from another origin. The
  // origin is the one at which most of the peer's first angles coincide with a hit of the same sensor.
  struct PharosAngle {
    double theta_rad;
    int station, axis;
    std::size_t sweep;
  };
  std::map<int, std::map<std::int64_t, PharosAngle>> own_angles;  // by sensor, by 48 MHz time
  const Decoded decoded = decode("two_bodies_hmd");
  for (std::size_t i = 0; i < decoded.sweeps.size(); ++i) {
    for (const Bearing& bearing : bearings_of(decoded.sweeps[i])) {
      const Flash& flash = decoded.sweeps[i].flash;
      const double rise_ticks = static_cast<double>(bearing.time_ticks) - 0.5 * bearing.width_ticks;
      own_angles[bearing.sensor][std::llround(rise_ticks * 0.96)] = {bearing.theta_rad, flash.station,
                                                                     index_of(flash.axis), i};
    }
  }
  std::map<std::int64_t, int> votes;
  // Less than a rotor's jitter, else an offset of a whole turn would count as well.
  constexpr std::int64_t kVote_ticks = 4;
  for (std::size_t i = 0; i < peers.size(); i += 50) {
    for (const auto& [time, hit] : own_angles[peers[i].sensor]) ++votes[(peers[i].timecode48 - time) / kVote_ticks];
  }
  const auto maximum =
      std::max_element(votes.begin(), votes.end(), [](auto& a, auto& b) { return a.second < b.second; });
  const std::int64_t origin = maximum->first * kVote_ticks;

  std::map<std::size_t, std::vector<double>> differences;  // by sweep, arcsec
  std::map<std::pair<int, int>, std::vector<double>> by_rotor;
  std::map<std::pair<int, int>, std::size_t> stations;
  constexpr std::int64_t kSamePulse_ticks = 8;
  std::size_t matched = 0;
  std::size_t in_time = 0;
  for (const PeerAngle& peer : peers) {
    const std::int64_t time = peer.timecode48 - origin;
    const auto& hits = own_angles[peer.sensor];
    const auto found = hits.lower_bound(time - kSamePulse_ticks);
    if (time < 0) continue;  // the recording begins later than the peer's list
    ++in_time;
    if (found == hits.end() || found->first > time + kSamePulse_ticks || found->second.axis != peer.axis) continue;
    ++matched;
    ++stations[{peer.station, found->second.station}];
    const double pharos_rad = found->second.theta_rad - kPi / 2;
    differences[found->second.sweep].push_back((pharos_rad - peer.angle_rad) * kArcsecPerRad);
    by_rotor[{peer.station, peer.axis}].push_back((pharos_rad - peer.angle_rad) * kArcsecPerRad);
  }
  EXPECT_GT(in_time, 20'000U);
  EXPECT_GT(static_cast<double>(matched), 0.98 * static_cast<double>(in_time));
  EXPECT_EQ(stations.size(), 2U) << "a peer's station is one station here";
  std::vector<double> spread;
  for (const auto& [sweep, values] : differences) {
    if (values.size() < 4) continue;
    spread.push_back(deviation(values));
  }
  EXPECT_LT(median(spread), 2.0);
  for (const auto& [rotor, values] : by_rotor) {
    const double offset = median(values);
    std::vector<double> rest;
    for (const double value : values) rest.push_back(std::abs(value - offset));
    std::printf("peer station %d axis %d: offset %.1f arcsec, median departure %.1f arcsec, %zu angles\n", rotor.first,
                rotor.second, offset, median(rest), values.size());
    EXPECT_LT(std::abs(offset), 30.0) << "tens of arcsec: the peer counts from the earliest rise";
    EXPECT_LT(median(rest), 3.0);
  }
}

}  // namespace
}  // namespace pharos::lighthouse
