// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "host/runtime/job_worker.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::host {

/// An image to be measured.
struct ImageJob {
  std::filesystem::path file;
  pointing::Observation observation;
};
struct ImageResult {
  pointing::Observation observation;
  std::string refusal;  ///< the word after refused_; empty where there is an answer
  std::string error;    ///< what it means, with the file's name; empty where there is an answer
  std::string flags;
  pointing::AxisEstimate axis;
  pointing::AxisPlanes planes_station;
};

/// A pass to be solved.
struct PassJob {
  std::vector<pointing::PassImage> images;
  pointing::PassOptions options;
};
struct PassResult {
  pointing::PassSolution answer;
  std::string error;  ///< of a fault of ours; else empty
};

using PointingJob = std::variant<ImageJob, PassJob>;
using PointingResult = std::variant<ImageResult, PassResult>;
using PointingWorker = JobWorker<PointingJob, PointingResult>;

/// Images that `camera` took, and passes, each in its turn.
PointingWorker pointing_worker(const PinholeCamera& camera);

}  // namespace pharos::host
