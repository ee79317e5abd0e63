// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "host/daemon/stereo/pair_estimator.hpp"
#include "host/runtime/job_worker.hpp"

namespace pharos::host {

/// An estimator's thread: one pair is processed and one may wait, which a newer one replaces. A queue would only make
/// poses older.
using PairWorker = JobWorker<StereoPairPtr, PairResult>;

/// Pairs for which the estimator throws are refused, `internal_error`.
inline PairWorker pair_worker(const std::shared_ptr<PairEstimator>& estimator) {
  return PairWorker(
      1, [estimator](const StereoPairPtr& pair) { return estimator->measure(*pair); },
      [estimator](const StereoPairPtr&, const std::string& error) {
        PairResult answer;
        answer.pose = estimator->no_pose();
        answer.refusal = kInternalError;
        answer.advice = error;
        return answer;
      });
}

}  // namespace pharos::host
