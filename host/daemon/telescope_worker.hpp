// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "host/daemon/job_worker.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::host {

/// An image to be measured.
struct ImageJob {
  std::filesystem::path file;
  pointing::Sighting sighting;
};
struct ImageResult {
  pointing::Sighting sighting;
  std::string refusal;  ///< the word after refused_; empty where there is an answer
  std::string trouble;  ///< what it means, with the file's name; empty where there is an answer
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
  pointing::PassAnswer answer;
  std::string trouble;  ///< of a fault of ours; else empty
};

using TelescopeJob = std::variant<ImageJob, PassJob>;
using TelescopeResult = std::variant<ImageResult, PassResult>;
using TelescopeWorker = JobWorker<TelescopeJob, TelescopeResult>;

/// Images that `camera` took, and passes, each in its turn.
TelescopeWorker telescope_worker(const PinholeCamera& camera);

}  // namespace pharos::host
