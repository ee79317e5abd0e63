// SPDX-License-Identifier: Apache-2.0
// The decoder of Lighthouse 2.0's light with any changes: of any time and order, mixed with good light. In every case
// each burst and beam is counted, all results are within their ranges and can be sent, and good light is decoded again.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/lighthouse/lh2_ootx_fields.hpp"
#include "pharos/report/convert.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame.hpp"
#include "support/input_bytes.hpp"
#include "support/lh2_light.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::InputBytes;
using pharos::test::require;
using namespace pharos::lighthouse;

constexpr double kTurn_ticks = 941'000.0 * 50.0 / 48.0;

const pharos::test::Lh2Station& good_station() {
  static const pharos::test::Lh2Station kStation(0x12BD0, 0x1CF73, 90'000);
  return kStation;
}

const Lh2Sequences& sequences() {
  static const Lh2Sequences kSequences;
  return kSequences;
}

class Watched {
 public:
  void push(const Lh2Edge& edge) {
    decoder_->push(edge);
    take();
  }
  void advance(std::int64_t ticks) {
    decoder_->advance(ticks);
    take();
  }
  void finish() {
    decoder_->flush();
    take();
    const Lh2Counters& c = decoder_->counters();
    require(bursts_accounted(c) == c.bursts && beams_accounted(c) == c.beams && c.outputs_overflow == 0);
  }
  std::size_t hits() const { return hits_; }

 private:
  void take() {
    while (const auto sweep = decoder_->take_sweep()) check(*sweep);
    while (const auto payload = decoder_->take_ootx()) {
      require(payload->station < kLh2Channels && !payload->bytes.empty());
      (void)lh2_ootx_fields({payload->bytes.data(), payload->bytes.size()});
    }
  }
  void check(const Lh2Sweep& sweep) {
    require(sweep.channel < kLh2Channels && sweep.plane < kPlanes && !sweep.hits.empty());
    for (const Lh2Hit& hit : sweep.hits) {
      require(hit.sensor < 32 && std::abs(lh2_hit_angle(sweep, hit)) < 2.1 && std::isfinite(lh2_hit_time(sweep, hit)));
    }
    std::array<std::uint8_t, pharos::wire::kMaxPayload> payload{};
    const auto message = pharos::report::to_wire(sweep);
    require(pharos::wire::encode_payload(message, payload) > 0 || !pharos::wire::is_plausible_time(message.sync_ticks));
    const Lh2Sweep again = pharos::report::from_wire(message);
    require(again.sync_sixths == sweep.sync_sixths && again.channel == sweep.channel && again.plane == sweep.plane);
    hits_ += sweep.hits.size();
  }

  std::unique_ptr<Lh2LightDecoder> decoder_ = std::make_unique<Lh2LightDecoder>(sequences());
  std::size_t hits_ = 0;
};

// Both planes over three sensors.
void good_turn(double sync_ticks, bool slow_bit, std::mt19937& random, Watched& watched) {
  std::vector<Lh2Edge> light;
  for (const std::size_t plane : {std::size_t{0}, std::size_t{1}}) {
    for (std::uint8_t sensor = 0; sensor < 3; ++sensor) {
      good_station().pass(sync_ticks, slow_bit, 38'000 + 39'000 * plane + 200U * sensor, 48, sensor, light, random);
    }
  }
  for (const Lh2Edge& edge : light) watched.push(edge);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes in(data, size);
  Watched watched;
  std::mt19937 random(1);
  std::int64_t now = 0;
  int turns = 0;
  while (!in.empty()) {
    const std::uint8_t what = in.byte();
    const auto sensor = static_cast<std::uint8_t>(what >> 4U);
    switch (what % 8U) {
      case 0:
      case 1:
      case 2: {  // changes close together, as in a burst
        const int count = in.byte();
        bool data_level = false;
        for (int i = 0; i < count; ++i) {
          const std::uint8_t step = in.byte();
          now += step % 64U;
          data_level = !data_level;
          watched.push({now, sensor, data_level, (step & 64U) == 0});
        }
        break;
      }
      case 3:
        now += in.number(3);
        break;
      case 4:  // a time of any kind
        watched.push({in.number(8), sensor, (what & 8U) != 0, true});
        break;
      case 5:
        watched.advance(in.number(8));
        break;
      case 6:
        if (turns++ > 20) break;
        good_turn(static_cast<double>(now) + 100.0, (what & 8U) != 0, random, watched);
        now += static_cast<std::int64_t>(kTurn_ticks);
        break;
      default:
        watched.push({now, static_cast<std::uint8_t>(in.byte()), (what & 8U) != 0, false});
        break;
    }
  }
  // Good light on sensors of its own: a time far ahead shuts only the sensor that had it.
  const std::size_t before = watched.hits();
  std::vector<Lh2Edge> light;
  now += 200'000'000;
  for (int turn = 0; turn < 4; ++turn) {
    const double sync = static_cast<double>(now) + kTurn_ticks * turn;
    for (const std::size_t place : {std::size_t{38'000}, std::size_t{77'000}}) {
      good_station().pass(sync, false, place, 48, 31, light, random);
    }
  }
  for (const Lh2Edge& edge : light) watched.push(edge);
  watched.finish();
  require(watched.hits() >= before + 6);
  return 0;
}
