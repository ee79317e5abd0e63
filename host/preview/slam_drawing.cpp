// SPDX-License-Identifier: Apache-2.0
#include "host/preview/slam_drawing.hpp"

namespace pharos::host {

Drawing slam_drawing(const slam::SlamSystem& system) {
  Drawing drawing;
  for (const auto& [u, v, kind] : system.last_features()) {
    drawing.dot({u, v}, kind > 1.5 ? colours::kGreen : kind > 0.5 ? colours::kYellow : colours::kRed);
  }
  return drawing;
}

}  // namespace pharos::host
