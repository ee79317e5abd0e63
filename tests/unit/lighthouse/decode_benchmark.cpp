// SPDX-License-Identifier: Apache-2.0
// Pulses a second of processor time through the decoder, in memory, one core: recorded light, in order and out of order
// by up to 200 us. usage: decode_benchmark [NAME...]; reads the recordings at $PHAROS_DATA.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>

#include "pharos/lighthouse/decoder.hpp"
#include "unit/lighthouse/recordings.hpp"

namespace {

using pharos::lighthouse::Decoder;
using pharos::lighthouse::RawPulse;

constexpr int kLaps = 10;

/// Processor seconds (independent of other load) for kLaps repetitions of the recording, consecutive in time; the
/// minimum of five.
double seconds_for(const std::vector<RawPulse>& pulses, std::int64_t span_ticks, std::size_t& hits) {
  double best = 1e9;
  for (int repeat = 0; repeat < 5; ++repeat) {
    Decoder decoder;
    hits = 0;
    const std::clock_t begin = std::clock();
    for (int lap = 0; lap < kLaps; ++lap) {
      for (RawPulse pulse : pulses) {
        pulse.rise_ticks += lap * span_ticks;
        pulse.fall_ticks += lap * span_ticks;
        decoder.push(pulse);
        while (const auto sweep = decoder.take_sweep()) hits += sweep->hits.size();
        while (decoder.take_ootx()) {
        }
      }
    }
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

void measure(const char* name) {
  auto pulses = pharos::test::recorded_pulses(name);
  std::erase_if(pulses, [](const RawPulse& pulse) { return pulse.fall_ticks - pulse.rise_ticks > 10'000; });
  std::int64_t span = 0;
  for (const RawPulse& pulse : pulses) span = std::max(span, pulse.fall_ticks);
  span += 400'000;
  std::vector<std::pair<std::int64_t, RawPulse>> arrivals;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> late(0, 10'000);
  for (const RawPulse& pulse : pulses) arrivals.emplace_back(pulse.fall_ticks + late(random), pulse);
  std::stable_sort(arrivals.begin(), arrivals.end(), [](auto& a, auto& b) { return a.first < b.first; });
  std::vector<RawPulse> shuffled;
  for (const auto& arrival : arrivals) shuffled.push_back(arrival.second);
  for (const auto* order : {&pulses, &shuffled}) {
    std::size_t hits = 0;
    const double seconds = seconds_for(*order, span, hits);
    const double count = static_cast<double>(order->size()) * kLaps;
    std::printf("%-22s %-9s %5.1f M pulses/s, %.0f ns a pulse, %zu hits\n", name,
                order == &pulses ? "as it is" : "shuffled", 1e-6 * count / seconds, 1e9 * seconds / count, hits);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (!std::filesystem::exists(pharos::test::recordings())) {
    std::fprintf(stderr, "no recordings at %s: set PHAROS_DATA\n", pharos::test::recordings().c_str());
    return 1;
  }
  if (argc > 1) {
    for (int i = 1; i < argc; ++i) measure(argv[i]);
  } else {
    for (const char* name : {"hmd_static", "controller_quick", "two_bodies_hmd", "two_bodies_controller"})
      measure(name);
  }
  return 0;
}
