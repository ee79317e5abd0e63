// SPDX-License-Identifier: Apache-2.0
// The decoder with any light: pulses and edges of any time and length, mixed with good light. In every case each pulse
// is counted, all results are within their ranges, and good light is decoded again within twelve flashes.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/lighthouse/sorted_decoder.hpp"
#include "pharos/report/convert.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame.hpp"
#include "support/input_bytes.hpp"
#include "support/require.hpp"
#include "support/synthetic_light.hpp"

namespace {

using pharos::test::InputBytes;
using pharos::test::require;
using namespace pharos::lighthouse;
using pharos::test::SyntheticLight;

/// Checks every result of the decoder.
template <class AnyDecoder>
class Watched {
 public:
  AnyDecoder decoder;

  void take() {
    while (const auto sweep = decoder.take_sweep()) check(*sweep);
    while (const auto payload = decoder.take_ootx()) require(payload->station < 2 && !payload->bytes.empty());
  }
  std::size_t lit_since(std::int64_t start_ticks) const {
    std::size_t count = 0;
    for (const std::int64_t start : lit_) count += start >= start_ticks ? 1U : 0U;
    return count;
  }

 private:
  void check(const Sweep& sweep) {
    const Flash& flash = sweep.flash;
    require(flash.station < 2);
    require(flash.start_ticks > last_start_);  // time never runs backwards
    last_start_ = flash.start_ticks;
    require(sweep.period_sixteenth_ticks > 13'000'000 && sweep.period_sixteenth_ticks < 13'700'000);
    require(!flash.skip || sweep.hits.empty());
    std::array<std::uint8_t, pharos::wire::kMaxPayload> payload{};
    require(pharos::wire::encode_payload(pharos::report::to_wire(sweep), payload) > 0);  // it can be encoded
    if (!flash.skip) lit_.push_back(flash.start_ticks);
    const std::size_t rotor = std::size_t{2} * flash.station + static_cast<std::size_t>(index_of(flash.axis));
    const SmoothedFlash smoothed = smoother_[rotor].push(sweep);
    require(std::isfinite(smoothed.offset_ticks) && std::abs(smoothed.offset_ticks) < 1000.0);
    require(std::abs(smoothed.period_ticks / kNominalPeriod_ticks - 1.0) < 0.03);
    for (const Bearing& bearing : bearings_of(sweep, smoothed)) {
      require(std::isfinite(bearing.theta_rad) && bearing.theta_rad > 0.0 && bearing.theta_rad < 3.2);
      require(bearing.sensor < 32);
    }
  }

  FlashSmoother smoother_[4];
  std::vector<std::int64_t> lit_;
  std::int64_t last_start_ = INT64_MIN;
};

SyntheticLight light_at(std::int64_t ticks, bool lone) {
  SyntheticLight::Settings settings;
  settings.begin_s = static_cast<double>(ticks) / 50e6;
  if (lone) settings.layout = SyntheticLight::Layout::kLoneA;
  return SyntheticLight(settings);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes in(data, size);
  Watched<Decoder> watched;
  Watched<SortedDecoder> promised;  // the same edges, which violate its precondition on their order
  Decoder& decoder = watched.decoder;
  const bool edges_only = (in.byte() & 1U) != 0;
  const auto push_edge = [&](const Edge& edge) {
    decoder.push(edge);
    promised.decoder.push(edge);
    promised.take();
  };
  std::int64_t now = 50'000'000;
  std::size_t lights = 0;
  while (!in.empty()) {
    const std::uint8_t what = in.byte();
    const std::uint8_t sensor = in.byte() % 40;
    switch (what % 8) {
      case 0:
      case 1: {  // a pulse or edge near the present time, of any plausible length and more
        now += in.number(2);
        const std::int64_t width = in.number(2) / 6 - 16;
        if (edges_only) {
          push_edge(Edge{now, sensor, (width & 1) != 0});
        } else {
          decoder.push(RawPulse{now, now + width, sensor});
        }
        break;
      }
      case 2: {  // the same flash on several sensors
        now += in.number(2);
        const std::int64_t width = 2'600 + in.number(2) % 4'600;
        for (std::uint8_t i = 0; i < 4; ++i) {
          push_edge(Edge{now, i, true});
          push_edge(Edge{now + width, i, false});
        }
        break;
      }
      case 3:  // at another time: past or future
        if (edges_only) {
          push_edge(Edge{now + (in.number(5) - (std::int64_t{1} << 39)), sensor, (what & 8U) != 0});
        } else {
          const std::int64_t rise = now + (in.number(5) - (std::int64_t{1} << 39));
          decoder.push(RawPulse{rise, rise + 3'200, sensor});
        }
        break;
      case 4:  // arbitrary numbers
        if (edges_only) {
          push_edge(Edge{in.number(8), sensor, (what & 8U) != 0});
        } else {
          const std::int64_t rise = in.number(8);
          decoder.push(RawPulse{rise, in.number(8), sensor});
        }
        break;
      case 5:  // good light for a while
        if (++lights > 8) break;
        for (const RawPulse& pulse : light_at(now, (what & 8U) != 0).slots(0, 8 + sensor % 16)) {
          if (edges_only) {
            push_edge(Edge{pulse.rise_ticks, pulse.sensor, true});
            push_edge(Edge{pulse.fall_ticks, pulse.sensor, false});
          } else {
            decoder.push(pulse);
          }
          watched.take();
          now = pulse.fall_ticks;
        }
        break;
      case 6:  // the clock
        promised.decoder.advance(now);
        decoder.advance(now + in.number(3));
        break;
      default:  // a pause
        now += in.number(4) / 8;
        break;
    }
    watched.take();
  }
  // Good light at the end, after a pause.
  now += 15'000'000;
  const SyntheticLight light = light_at(now, false);
  for (const RawPulse& pulse : light.slots(0, 40)) {
    if (edges_only) {
      push_edge(Edge{pulse.rise_ticks, pulse.sensor, true});
      push_edge(Edge{pulse.fall_ticks, pulse.sensor, false});
    } else {
      decoder.push(pulse);
    }
    watched.take();
  }
  decoder.flush();
  watched.take();
  const DecoderCounters& counters = decoder.counters();
  require(counters.pulses_in == pulses_accounted(counters));
  if (edges_only) require(counters.edges_in == edges_accounted(counters));
  promised.decoder.flush();
  promised.take();
  const DecoderCounters& promised_counters = promised.decoder.counters();
  require(promised_counters.edges_in == edges_accounted(promised_counters) &&
          promised_counters.pulses_in == pulses_accounted(promised_counters));
  // Twelve flashes are six slots. The input before may shift the time base while the light is on: half a slot of
  // tolerance.
  constexpr std::int64_t kHalfSlot_ticks = 208'333;
  require(watched.lit_since(light.flash(0, 6).start_ticks + decoder.time_offset_ticks() - kHalfSlot_ticks) >= 34);
  return 0;
}
