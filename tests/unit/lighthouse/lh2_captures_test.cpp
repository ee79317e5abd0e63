// SPDX-License-Identifier: Apache-2.0
// Captures of a logic analyser on a receiver of Lighthouse 2.0, and OOTX bits that libsurvive recorded.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "host/table/lh2_light_reader.hpp"
#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/lighthouse/lh2_ootx_fields.hpp"
#include "support/real_data.hpp"

namespace pharos::lighthouse {
namespace {

struct LightCapture {
  const char* name;
  std::size_t turns;  // with both planes' light
};

constexpr std::array<LightCapture, 2> kCaptures = {{{"take2", 51}, {"about_4m", 51}}};

std::vector<Lh2Edge> edges_of(const LightCapture& capture) {
  const auto path = test::real_data("open") / "lh2_light" / (std::string(capture.name) + ".csv.gz");
  host::Lh2LightReader reader(host::ByteSource(path.string()));
  std::vector<Lh2Edge> edges;
  while (const auto edge = reader.next()) edges.push_back(*edge);
  return edges;
}

TEST(Lh2Captures, EveryBurstsBitsAreOneStations) {
  PHAROS_NEEDS_DATA("open/lh2_light");
  const auto sequences = std::make_unique<Lh2Sequences>();
  for (const LightCapture& capture : kCaptures) {
    Lh2Counters counters;
    const auto collector = std::make_unique<Lh2BurstCollector>();
    std::vector<Lh2Beam> beams;
    std::size_t bursts = 0;
    const auto take = [&](const std::optional<Lh2Burst>& burst) {
      if (!burst) return;
      ++bursts;
      const auto bits = biphase_bits(*burst);
      ASSERT_TRUE(bits);
      const auto beam = identify(*bits, kAllLh2Channels, *sequences);
      ASSERT_TRUE(beam) << capture.name << " at " << ticks_to_seconds(burst->start_ticks);
      EXPECT_EQ(beam->channel, 6);
      EXPECT_GE(beam->bits, 25);
      beams.push_back(*beam);
    };
    for (const Lh2Edge& edge : edges_of(capture)) take(collector->push(edge, counters));
    take(collector->flush(counters));
    // Both planes of a turn, each by itself and without the clocks' ratio, lead to one sync.
    std::size_t turns = 0;
    for (std::size_t i = 0; i + 1 < beams.size(); ++i) {
      const auto sync = [](const Lh2Beam& beam) { return beam.time_sixths - std::int64_t{beam.place} * kBit_sixths; };
      const auto apart = sync(beams[i + 1]) - sync(beams[i]);
      if (std::abs(apart) > 100'000) continue;  // the next turn's
      ++turns;
      EXPECT_LE(std::abs(apart), 30) << capture.name << " turn " << turns;  // 0.1 us
      EXPECT_EQ(beams[i].slow_bit, beams[i + 1].slow_bit);
    }
    EXPECT_EQ(turns, capture.turns);
    std::printf("%s: %zu bursts, %zu turns\n", capture.name, bursts, turns);
  }
}

TEST(Lh2Captures, SyncsOfBothPlanesAgreeTo20ns) {
  PHAROS_NEEDS_DATA("open/lh2_light");
  const auto sequences = std::make_unique<Lh2Sequences>();
  for (const LightCapture& capture : kCaptures) {
    const auto decoder = std::make_unique<Lh2LightDecoder>(*sequences);
    std::vector<Lh2Sweep> sweeps;
    const auto take = [&] {
      while (const auto sweep = decoder->take_sweep()) sweeps.push_back(*sweep);
    };
    for (const Lh2Edge& edge : edges_of(capture)) {
      decoder->push(edge);
      take();
    }
    decoder->flush();
    take();
    EXPECT_EQ(decoder->counters().hits, decoder->counters().beams);  // none refused
    for (std::size_t i = 4; i + 1 < sweeps.size(); ++i) {
      if (sweeps[i].plane != 0 || sweeps[i + 1].plane != 1) continue;
      EXPECT_LE(std::abs(sweeps[i + 1].sync_sixths - sweeps[i].sync_sixths), 6) << capture.name << " sweep " << i;
    }
    // A receiver at rest: what follows from hit to hit, without slow motion; 4.6 to 6.2 arcsec were measured.
    for (const std::uint8_t plane : {std::uint8_t{0}, std::uint8_t{1}}) {
      std::vector<double> steps;
      std::optional<double> last;
      for (const Lh2Sweep& sweep : sweeps) {
        if (sweep.plane != plane) continue;
        const double angle = lh2_hit_angle(sweep, sweep.hits[0]);
        if (last) steps.push_back(std::abs(angle - *last));
        last = angle;
      }
      std::sort(steps.begin(), steps.end());
      EXPECT_LT(steps[steps.size() / 2] / kRadPerArcsec, 7.0) << capture.name;
    }
  }
}

// Lines "time device Y channel time48 bit generation": one bit a turn, in order for each device.
TEST(Lh2Captures, OotxOfARealStationGivesItsCalibration) {
  PHAROS_NEEDS_DATA("open/libsurvive");
  std::map<std::uint32_t, std::set<std::string>> seen;  // id -> payload
  for (const char* name : {"haagh-tracking", "lh2_test_cal"}) {
    host::LineReader lines(
        host::ByteSource((test::real_data("open") / "libsurvive" / (std::string(name) + ".rec.gz")).string()),
        host::LastLine::kDropUnfinished);
    std::map<std::string, OotxFrames> frames;
    DecoderCounters counters;
    while (const auto line = lines.next()) {
      std::istringstream words{std::string(*line)};
      std::string time, device, kind, channel, ticks;
      int bit = 0;
      if (!(words >> time >> device >> kind >> channel >> ticks >> bit) || kind != "Y") continue;
      const auto payload = frames[device + channel].push(bit != 0, true, counters);
      if (!payload) continue;
      const auto fields = lh2_ootx_fields({payload->data(), payload->size()});
      ASSERT_TRUE(fields);
      EXPECT_EQ(std::to_string(fields->mode & 0xF), channel);  // the station knows its channel
      std::string text;
      for (const std::uint8_t byte : *payload) text += std::to_string(byte) + " ";
      seen[fields->calibration.id].insert(text);
    }
    EXPECT_EQ(counters.ootx_bad_crc, 0U) << name;
  }
  // One in haagh-tracking (the other's bits have gaps), two in lh2_test_cal.
  EXPECT_EQ(seen.size(), 3U);
  EXPECT_TRUE(seen.contains(4261648623U));
  for (const auto& [id, payloads] : seen) EXPECT_EQ(payloads.size(), 1U) << id;
}

}  // namespace
}  // namespace pharos::lighthouse
