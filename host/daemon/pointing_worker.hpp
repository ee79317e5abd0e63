// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "host/publish/measurement_header.hpp"
#include "host/runtime/job_worker.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::host {

/// An image to be measured.
struct ImageJob {
  std::filesystem::path file;
  pointing::Observation observation;
};
/// What became of it; the advice names the file.
struct ImageResult : MeasurementOutcome {
  pointing::Observation observation;
  std::string remark;  ///< what was made of the image; mostly empty
  pointing::AxisEstimate axis;
  pointing::AxisPlanes planes_station;
};

/// A pass to be solved.
struct PassJob {
  std::vector<pointing::PassImage> images;
  pointing::PassOptions options;
};
/// What became of it; advice only of a fault of ours. Of a refused one the estimate still tells images and time.
struct PassResult : MeasurementOutcome {
  pointing::PassEstimate estimate;
};

using PointingJob = std::variant<ImageJob, PassJob>;
using PointingResult = std::variant<ImageResult, PassResult>;
using PointingWorker = JobWorker<PointingJob, PointingResult>;

/// Images that `camera` took, and passes, each in its turn.
PointingWorker pointing_worker(const PinholeCamera& camera);

}  // namespace pharos::host
