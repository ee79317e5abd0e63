// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "host/preview/preview_picture.hpp"
#include "host/publish/measurement_header.hpp"
#include "host/runtime/job_worker.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::host {

/// An image to be measured.
struct ImageJob {
  std::filesystem::path file;
  pointing::Observation observation;
  bool with_picture = false;  ///< of what is found in it, for people
};
/// Result of an image; the advice names the file.
struct ImageResult : MeasurementOutcome {
  pointing::Observation observation;
  std::string remark;  ///< how the image was converted; mostly empty
  pointing::AxisEstimate axis;
  pointing::AxisPlanes planes_station;
  std::vector<AnnotatedImage> pictures;  ///< one, if the job asks for it and the image is readable
};

/// A pass to be solved.
struct PassJob {
  std::vector<pointing::PassImage> images;
  pointing::PassOptions options;
};
/// Result of a pass; it has advice only after an internal error. If refused, the estimate still has images and time.
struct PassResult : MeasurementOutcome {
  pointing::PassEstimate estimate;
};

using PointingJob = std::variant<ImageJob, PassJob>;
using PointingResult = std::variant<ImageResult, PassResult>;
using PointingWorker = JobWorker<PointingJob, PointingResult>;

/// Measures images of `camera` and solves passes, in the order in which they were posted.
PointingWorker pointing_worker(const PinholeCamera& camera);

}  // namespace pharos::host
