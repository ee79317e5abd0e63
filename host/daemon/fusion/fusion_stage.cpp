// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/fusion/fusion_stage.hpp"

#include <cmath>

namespace pharos::host {
namespace {

// After this many poses in a row whose times are more than a second behind, and none that is not, the clock was set
// back.
constexpr int kBackRun = 10;
constexpr double kBack_s = 1.0;

std::vector<SourceMounting> mountings_of(const VehicleConfig& config) {
  std::vector<SourceMounting> out;
  for (const FusedSourceConfig& source : config.sources) out.push_back(source.mounting);
  return out;
}

}  // namespace

FusionStage::FusionStage(const VehicleConfig& config) : fuser_(mountings_of(config), config.fusion) {}

FusionResult FusionStage::take(const FusionJob& job) {
  FusionResult out;
  if (job.restart) {
    fuser_.reset();
    ++restarts_;
  }
  if (job.pose) {
    out.outcome = fuser_.push(job.pose->source, job.pose->row);
    note_time(out.outcome, *job.pose);
  }
  out.state = fuser_.state(job.now_ns);
  out.counters = fuser_.estimator().counters();
  out.restarts = restarts_;
  return out;
}

// A clock that was set forward is found by the estimator.
void FusionStage::note_time(const fusion::Outcome& outcome, const TakenPose& pose) {
  const bool refused =
      outcome.refusal == fusion::Refusal::kTimeGoesBack || outcome.refusal == fusion::Refusal::kTooLate;
  const double behind_s = static_cast<double>(fuser_.estimator().newest_ns()) * 1e-9 - pose.row.time_s;
  if (!refused || behind_s < kBack_s) {
    back_run_ = 0;
    return;
  }
  if (++back_run_ < kBackRun) return;
  back_run_ = 0;
  ++restarts_;
  fuser_.reset();
}

}  // namespace pharos::host
