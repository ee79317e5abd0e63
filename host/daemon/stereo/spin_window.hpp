// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/publish/spin_report.hpp"
#include "host/vision/slam/tracked_frame.hpp"

namespace pharos::host {

/// A target's spin, or the reason why there is none.
struct SpinResult {
  std::string refusal;  // the word after refused_; empty if there is a spin
  SpinEstimate spin;
};

/// Fits a spin to the attitudes of the last seconds, once per second of the pairs' time (a fit takes some 4 ms).
class SpinWindow {
 public:
  /// Takes the next pair's result, with or without a pose. Empty if no spin is due.
  std::optional<SpinResult> push(const slam::TrackedFrame& frame);
  /// To be called for a new map, in which attitudes are relative to another pair.
  void clear();

 private:
  std::vector<slam::TrackedFrame> attitudes_;
  std::optional<double> last_reported_s_;
};

}  // namespace pharos::host
