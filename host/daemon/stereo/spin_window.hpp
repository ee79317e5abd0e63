// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/publish/spin_report.hpp"
#include "host/vision/slam/tracked_frame.hpp"

namespace pharos::host {

/// What is to be told of a target's turning: a spin, or why there is none.
struct SpinResult {
  std::string refusal;  // the word after refused_; empty where there is a spin
  SpinEstimate spin;
};

/// Attitudes of the last seconds to a spin, told once a second of the pairs' time (a fit takes some 4 ms).
class SpinWindow {
 public:
  /// The next pair's frame, with or without a pose. Empty where nothing is due.
  std::optional<SpinResult> push(const slam::TrackedFrame& frame);
  /// A new map has other attitudes.
  void clear();

 private:
  std::vector<slam::TrackedFrame> attitudes_;
  std::optional<double> last_reported_s_;
};

}  // namespace pharos::host
