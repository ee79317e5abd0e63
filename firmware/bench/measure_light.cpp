// SPDX-License-Identifier: Apache-2.0
// Instructions from edges to sweeps, and from sweeps to poses, over a recording.
#include "firmware/bench/light.hpp"
#include "firmware/bench/report.hpp"
#include "pharos/lighthouse/sorted_decoder.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace {

using namespace pharos;  // NOLINT: a program of one page
using bench::Counts;

struct Measured {
  lighthouse::SortedDecoder decoder;
  Counts edge, pose, dark;  // instructions an edge; a sweep that completed a cycle; any other sweep
  std::int64_t track_sum = 0;
  std::uint32_t answers = 0, ambiguous = 0, hits = 0, payloads = 0;
};
Measured measured;

void take(track::EpochTracker& tracker, const lighthouse::Sweep& sweep) {
  std::optional<track::EpochResult> result;
  const std::uint32_t count = bench::instructions_of([&] { result = tracker.push(sweep); });
  measured.hits += sweep.hits.size();
  measured.track_sum += count;
  (result ? measured.pose : measured.dark).add(count);
  if (!result || !result->pose.ok()) return;
  ++measured.answers;
  measured.ambiguous += result->pose->ambiguous() ? 1U : 0U;
}

}  // namespace

int main() {
  bench::Input input;
  const auto& header = input.header<bench::LightHeader>();
  static const Target target = bench::target_of(input, header.sensors);
  track::TrackOptions options;
  options.warm_start = true;
  options.solve.sigma_rad = header.sigma_rad;
  static track::EpochTracker tracker(target, options);
  for (std::uint32_t k = 0; k < header.stations; ++k) {
    tracker.set_calibration(static_cast<std::uint8_t>(k), bench::calibration_of(input.next<bench::StationRow>()));
  }
  std::int64_t first_ticks = 0, last_ticks = 0;
  for (std::uint32_t k = 0; k < header.edges; ++k) {
    const lighthouse::Edge edge = bench::edge_of(input.next<bench::EdgeRow>());
    if (k == 0) first_ticks = edge.stamp_ticks;
    last_ticks = edge.stamp_ticks;
    std::uint32_t count = bench::instructions_of([&] { measured.decoder.push(edge); });
    // As in the program (app/program.cpp): processed in place.
    for (bool more = true; more;) {
      const bench::Count looking;
      const lighthouse::Sweep* sweep = measured.decoder.next_sweep();
      count += looking.instructions();
      more = sweep != nullptr;
      if (!more) continue;
      take(tracker, *sweep);
      count += bench::instructions_of([&] { measured.decoder.drop_sweep(); });
    }
    const bench::Count looking;
    const bool payload = measured.decoder.next_ootx() != nullptr;
    count += looking.instructions();
    if (payload) {
      ++measured.payloads;
      measured.decoder.drop_ootx();
    }
    measured.edge.add(count);
  }
  bench::say("edge", measured.edge);
  bench::say("pose", measured.pose);
  bench::say("sweep", measured.dark);
  bench::say("track_sum", measured.track_sum);
  bench::say("hits", measured.hits);
  bench::say("answers", measured.answers);
  bench::say("ambiguous", measured.ambiguous);
  bench::say("payloads", measured.payloads);
  bench::say("ticks", last_ticks - first_ticks);
  bench::say("decoder_bytes", sizeof(lighthouse::SortedDecoder));
  bench::say("tracker_bytes", sizeof(track::EpochTracker));
  return 0;
}
