// SPDX-License-Identifier: Apache-2.0
// LighthousePipeline's part for stations of Lighthouse 2.0: sweeps to poses in the world.
#include <cmath>

#include "host/daemon/lighthouse_pipeline.hpp"
#include "host/publish/messages.hpp"
#include "host/publish/words.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/lh2_ootx_fields.hpp"

namespace pharos::host {
namespace {

void add_network_flags(std::uint8_t flags, std::string& words) {
  if ((flags & network::kFused) != 0) add_flag_word(words, "fused");
  if ((flags & network::kOutliers) != 0) add_flag_word(words, "outliers");
  if ((flags & network::kStationExcluded) != 0) add_flag_word(words, "station_excluded");
}

WorldPoseReport report_of(const network::NetworkResult& result) {
  WorldPoseReport report;
  report.observations = result.observations;
  add_network_flags(result.flags, report.flags);
  if (!result.pose) {
    report.refusal = pose::name_of(result.pose.error());
    return report;
  }
  report.pose.pose = *result.pose;
  report.pose.covariance = result.covariance;
  report.pose.residual_rms = result.residual_rms_rad;
  report.pose.observations = result.observations;
  report.ambiguous = result.ambiguous;
  if (result.ambiguous) report.pose.second = {result.second, result.delta_chi2};
  return report;
}

}  // namespace

void LighthousePipeline::take(const lighthouse::Lh2Sweep& sweep) {
  if (!world_) {
    ++counters_.sweeps_bad_station;  // of generation 2 on a line of generation 1
    return;
  }
  ++counters_.sweeps;
  last_sweep_ns_ = arrival_.monotonic_ns;
  world_->push(sweep);
  answer_world();
}

void LighthousePipeline::take(const report::Lh2OotxReport& report) {
  ++counters_.ootx_payloads;
  const auto fields = lighthouse::lh2_ootx_fields({report.payload.bytes.data(), report.payload.bytes.size()});
  if (!fields) {
    ++counters_.ootx_unreadable;
    return;
  }
  const network::Station* station = network::find_station(config_.stations, report.payload.station);
  if (station == nullptr || station->id == 0 || station->id == fields->calibration.id) return;
  log_.warn("other station",
            "channel " + std::to_string(report.payload.station) + " is station " +
                station_id_text(fields->calibration.id) + ", not " + station_id_text(station->id) + " of " +
                config_.stations_file.string() + ": its pose and calibration are another's",
            arrival_.monotonic_ns);
}

void LighthousePipeline::answer_world() {
  while (const auto result = world_->next()) {
    auto report = report_of(*result);
    if (!gate_.finite(report)) continue;
    if (refuse_wrong_target(report)) {
      report.ambiguous = false;
    } else if (!result->pose) {
      counters_.count_refusal(result->pose.error());
      last_refusal_ = pose::name_of(result->pose.error());
    } else {
      ++(report.ambiguous ? counters_.cycles_ambiguous : counters_.cycles_ok);
    }
    delivery_.on_answer(report.answered(), arrival_.monotonic_ns);
    const auto time_ticks = static_cast<std::int64_t>(std::llround(result->time_s / kSecondsPerTick));
    if (!stamp_time(report, time_ticks)) continue;
    if (!gate_.publish(report) || !report.answered()) continue;
    rate_.on_pose(arrival_.monotonic_ns);
    latency_.add(host_clock_.monotonic_ns() - push_began_ns_);
  }
}

}  // namespace pharos::host
