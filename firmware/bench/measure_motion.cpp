// SPDX-License-Identifier: Apache-2.0
// Instructions from sweeps to motion-aware poses over a recording of two stations: each alone at first, then fused.
#include "firmware/bench/light.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/motion/motion_tracker.hpp"

namespace {

using namespace pharos;  // NOLINT: a program of one page

// Two seconds; both tracks are settled after one.
constexpr std::uint32_t kSweeps = 240;

struct Measured {
  lighthouse::Decoder decoder;
  bench::Counts alone, fused;  // instructions a sweep that gave a result
  std::uint32_t sweeps = 0, hits_alone = 0, hits_fused = 0;
};
Measured measured;

void take(motion::MotionTracker& tracker, const lighthouse::Sweep& sweep) {
  std::optional<track::EpochResult> result;
  const std::uint32_t count = bench::instructions_of([&] { result = tracker.push(sweep); });
  if (!result) return;
  ++measured.sweeps;
  if (!result->pose.ok()) return;
  const bool fused = tracker.pair().joint() != nullptr;
  (fused ? measured.fused : measured.alone).add(count);
  (fused ? measured.hits_fused : measured.hits_alone) += sweep.hits.size();
}

}  // namespace

int main() {
  bench::Input input;
  const auto& header = input.header<bench::LightHeader>();
  static const Target target = bench::target_of(input, header.sensors);
  motion::MotionOptions options;
  options.solve.sigma_rad = header.sigma_rad;
  static motion::MotionTracker tracker(target, options);
  for (std::uint32_t k = 0; k < header.stations; ++k) {
    tracker.set_calibration(static_cast<std::uint8_t>(k), bench::calibration_of(input.next<bench::StationRow>()));
  }
  for (std::uint32_t k = 0; k < header.edges && measured.sweeps < kSweeps; ++k) {
    measured.decoder.push(bench::edge_of(input.next<bench::EdgeRow>()));
    while (const lighthouse::Sweep* sweep = measured.decoder.next_sweep()) {
      take(tracker, *sweep);
      measured.decoder.drop_sweep();
    }
    if (measured.decoder.next_ootx() != nullptr) measured.decoder.drop_ootx();
  }
  bench::say("alone", measured.alone);
  bench::say("fused", measured.fused);
  bench::say("hits_alone", measured.hits_alone);
  bench::say("hits_fused", measured.hits_fused);
  bench::say("tracker_bytes", sizeof(motion::MotionTracker));
  return 0;
}
