// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/tof_pipeline.hpp"

#include <utility>

#include "host/publish/messages.hpp"
#include "host/publish/words.hpp"

namespace pharos::host {
namespace {

constexpr const char* kFramesLost = "the network or this computer loses them: see device.frames_...";

// Until it is known how often poses come: a mean of many frames takes as long as these.
std::int64_t first_wait_ns(const TofConfig& config) { return kSilence_ns + config.average_frames * kSilence_ns / 10; }

}  // namespace

TofPipeline::TofPipeline(const TofConfig& config, const PublishConfig& publish, const std::string& source,
                         Publisher& publisher, const Clock& clock)
    : config_(config),
      source_(source),
      host_clock_(clock),
      log_(config.name),
      average_(config.average_frames),
      gate_(publisher, counters_.frames_not_finite,
            PublishGate::AgeLimit{publish.max_age_ns(), counters_.frames_stale}),
      delivery_("frames", kFramesLost),
      changes_(first_wait_ns(config)) {}

/// Exposure time of the frame; empty, and counted, if the frame cannot be used.
std::optional<MappedTime> TofPipeline::time_of(const DepthFrame& frame) {
  const std::uint64_t ignored = clock_.map().counters().pairs_ignored;
  const std::optional<MappedTime> time = clock_.time_of(frame);
  if (clock_step_.update(clock_.map(), frame.complete_monotonic_ns)) {
    log_.warn("host clock", clock_step_.notice(frame.complete_monotonic_ns), frame.complete_monotonic_ns);
    last_utc_ns_ = 0;
  }
  if (!time) {
    ++(clock_.map().counters().pairs_ignored != ignored ? counters_.frames_time_back : counters_.frames_no_clock);
    return std::nullopt;
  }
  if (time->utc_ns <= last_utc_ns_) {
    ++counters_.frames_time_back;
    return std::nullopt;
  }
  last_utc_ns_ = time->utc_ns;
  return time;
}

std::optional<MappedTime> TofPipeline::take(const DepthFrame& frame) {
  const std::int64_t began_ns = host_clock_.monotonic_ns();
  rate_.on_data(frame.complete_monotonic_ns);
  transport_.add(frame.complete_monotonic_ns - frame.arrival_monotonic_ns);
  waiting_.add(began_ns - frame.complete_monotonic_ns);
  const PinholeCamera& intrinsics = config_.camera.intrinsics;
  if (frame.width_px != intrinsics.width_px || frame.height_px != intrinsics.height_px) {
    ++counters_.frames_wrong_size;
    return std::nullopt;
  }
  const std::optional<MappedTime> time = time_of(frame);
  if (!time) return std::nullopt;
  if (!gate_.fresh(began_ns - time->monotonic_ns)) {  // waited too long: the estimator has newer ones to work on
    delivery_.on_answer(false, began_ns);
    return std::nullopt;
  }
  return time;
}

std::optional<TofReport> TofPipeline::done(const TofWorker::Done& done) {
  estimator_.add(done.took_ns);
  for (std::size_t k = 0; k < tof::kTofStages; ++k) {
    if (done.answer.stage_ns[k] > 0) estimator_stages_[k].add(done.answer.stage_ns[k]);
  }
  TofResult result = done.answer;
  if (done.job.frame->taken_in_turns) add_flag_word(result.flags, "in_turns");
  return answer(result, done.job.time);
}

void TofPipeline::count(const TofReport& report) {
  if (report.answered()) {
    ++(report.ambiguous ? counters_.frames_ambiguous : counters_.frames_ok);
    return;
  }
  ++counters_.frames_refused;
  ++counters_.refused[report.refusal];
  last_refusal_ = report.refusal + ": " + report.advice;
}

TofReport TofPipeline::report_of(const TofResult& answer, const MappedTime& time) const {
  TofReport report;
  static_cast<MeasurementOutcome&>(report) = answer;
  report.utc_ns = time.utc_ns;
  report.utc_sigma_ns = time.sigma_ns;
  report.age_ns = host_clock_.monotonic_ns() - time.monotonic_ns;
  report.source = source_;
  report.sensor = config_.name;
  report.target = config_.target;
  report.pose = answer.estimate;
  report.ambiguous = answer.estimate.ambiguous();
  return report;
}

// Replaces the last frame of a window by the window's mean; false if the window is not full.
bool TofPipeline::average(TofReport& report) {
  if (report.ambiguous) return false;  // it is unknown which of the two poses belongs into the mean
  const auto mean = average_.push({report.pose, report.utc_ns, report.observations, report.flags});
  if (!mean) return false;
  report.utc_ns = mean->utc_ns;
  report.flags = mean->flags;
  if (mean->moving) add_flag_word(report.flags, "moving");
  report.observations = mean->observations;
  report.pose = mean->estimate;
  report.ambiguous = mean->estimate.ambiguous();
  return true;
}

// Loose frames are not checked: they cannot be from another sender, and may be of different views.
void TofPipeline::refuse_jump(TofReport& report, const MappedTime& time) {
  if (config_.is_loose() || !report.answered() || report.ambiguous) return;
  if (jump_check_.passes(report.pose, time.monotonic_ns)) return;
  report.refusal = kJumpRefusal;
  report.advice = kJumpAdvice;
  report.pose = {};
}

std::optional<TofReport> TofPipeline::answer(const TofResult& answer, const MappedTime& time) {
  TofReport report = report_of(answer, time);
  const bool passes = gate_.passes(report);
  if (passes) refuse_jump(report, time);
  delivery_.on_answer(passes && report.answered(), host_clock_.monotonic_ns());
  if (!passes) return std::nullopt;
  count(report);
  if (report.answered() && config_.average_frames > 1 && !average(report)) return report;
  publish(report);
  return report;
}

void TofPipeline::publish(TofReport& report) {
  const std::int64_t now_ns = host_clock_.monotonic_ns();
  if (!clock_step_.notice(now_ns).empty()) add_flag_word(report.flags, kClockSetWord);
  if (!gate_.publish(report) || !report.answered()) return;
  rate_.on_pose(now_ns);
  latency_.add(report.age_ns);
}

}  // namespace pharos::host
