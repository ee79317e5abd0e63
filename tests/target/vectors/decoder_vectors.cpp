// SPDX-License-Identifier: Apache-2.0
// Edges of two stations with the faults of real light -> sweeps, payloads, counters, frames on the line, angles.
#include <array>
#include <vector>

#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/lighthouse/flash_smoother.hpp"
#include "pharos/report/reporter.hpp"
#include "tests/support/synthetic_light.hpp"
#include "tests/target/vectors/draw.hpp"
#include "tests/target/vectors/result_line.hpp"
#include "tests/target/vectors/vectors.hpp"

namespace pharos::test {
namespace {

using namespace lighthouse;

// An OOTX frame takes 358 slots; the first has begun before lock.
constexpr std::int64_t kSlots = 800;
constexpr std::int64_t kTicksOfStale = 37 * 50'000'000LL;

std::vector<RawPulse> faulty_light() {
  // The OOTX payload of BEC08E38, and the same with another id.
  const auto a = ootx_bits(from_hex("063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100"));
  const auto b = ootx_bits(from_hex("063d398ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100"));
  SyntheticLight::Settings settings;
  settings.sensors = {0, 1, 2, 3, 5, 7, 8, 11, 13, 17, 21, 31};
  settings.bit = [&](int station, long n) {
    const auto& bits = station == 0 ? a : b;
    return static_cast<bool>(bits[static_cast<std::size_t>(n) % bits.size()]);
  };
  Draw draw(1);
  std::vector<RawPulse> light;
  for (RawPulse pulse : SyntheticLight(settings).slots(0, kSlots)) {
    if (draw.one_in(200)) continue;
    pulse.rise_ticks += draw.integer(-4, 4);
    pulse.fall_ticks += draw.integer(-4, 4);
    if (draw.one_in(500)) pulse.rise_ticks -= kTicksOfStale, pulse.fall_ticks -= kTicksOfStale;
    light.push_back(pulse);
    if (draw.one_in(50)) light.push_back({pulse.rise_ticks + 866, pulse.rise_ticks + 1'020, pulse.sensor});
    if (draw.one_in(300)) light.push_back(pulse);
  }
  return light;
}

void print(const Sweep& sweep) {
  ResultLine line("sweep");
  line << sweep.flash.start_ticks << sweep.flash.length_ticks << sweep.flash.station << index_of(sweep.flash.axis)
       << sweep.flash.data << sweep.flash.skip << sweep.flash.sensors << sweep.period_sixteenth_ticks << sweep.flags
       << sweep.hits.size();
  for (const Hit& hit : sweep.hits) line << hit.sensor << hit.width_ticks << hit.centre_half_ticks;
}

void print_frame(report::Reporter::Bytes bytes) {
  if (!bytes.empty()) ResultLine("frame") << bytes;
}

// One receiver: decoder, reporter and a smoother for each rotor.
struct Chain {
  Decoder decoder;
  report::Reporter reporter;
  std::array<std::array<FlashSmoother, kAxes>, kMaxStations> smoothers;

  void take() {
    while (const auto sweep = decoder.take_sweep()) {
      print(*sweep);
      print_frame(reporter.report(*sweep));
      print_angles(*sweep);
    }
    while (const auto payload = decoder.take_ootx()) {
      ResultLine("payload") << payload->time_ticks << payload->station
                            << std::span<const std::uint8_t>(payload->bytes.data(), payload->bytes.size());
      print_frame(reporter.report(*payload));
    }
  }
  void print_angles(const Sweep& sweep) {
    const SmoothedFlash smoothed =
        smoothers[sweep.flash.station][static_cast<std::size_t>(index_of(sweep.flash.axis))].push(sweep);
    ResultLine("smoothed") << smoothed.offset_ticks << smoothed.period_ticks;
    ResultLine line("bearing");
    for (const Bearing& bearing : bearings_of(sweep, smoothed)) {
      line << bearing.sensor << bearing.width_ticks << bearing.time_ticks << bearing.theta_rad;
    }
  }
  void finish() {
    decoder.flush();
    take();
    for_each_counter(decoder.counters(),
                     [](const char* name, std::uint32_t value, const char*) { ResultLine(name) << value; });
    print_frame(reporter.report(report::DecoderReport{.time_ticks = 1, .counters = decoder.counters()}));
  }
};

}  // namespace

void decoder_vectors() {
  const std::vector<RawPulse> light = faulty_light();
  Chain by_pulses;
  for (const RawPulse& pulse : light) {
    by_pulses.decoder.push(pulse);
    by_pulses.take();
  }
  by_pulses.finish();

  Chain by_edges;
  for (const RawPulse& pulse : light) {
    for (const Edge& edge : {Edge{pulse.rise_ticks, pulse.sensor, true}, Edge{pulse.fall_ticks, pulse.sensor, false}}) {
      print_frame(by_edges.reporter.report(edge, 0));
      by_edges.decoder.push(edge);
      by_edges.take();
    }
  }
  by_edges.finish();
}

}  // namespace pharos::test
