// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/clock/clock_map.hpp"
#include "host/daemon/tof_estimator.hpp"
#include "host/device/depth_frame.hpp"
#include "host/runtime/job_worker.hpp"

namespace pharos::host {

/// A frame to be measured, and when it was exposed.
struct TofJob {
  DepthFramePtr frame;
  MappedTime time;
};

/// An estimator's thread: the event loop, and with it the arrival times of every line's bytes, never waits for a frame.
using TofWorker = JobWorker<TofJob, TofResult>;

/// Frames for which the estimator throws are refused, `internal_error`. `estimator` must outlive the worker.
inline TofWorker tof_worker(TofEstimator& estimator) {
  return TofWorker(
      1, [&estimator](const TofJob& job) { return estimator.measure(*job.frame); },
      [](const TofJob&, const std::string& error) {
        TofResult result;
        result.refusal = kInternalError;
        result.advice = error;
        return result;
      });
}

}  // namespace pharos::host
