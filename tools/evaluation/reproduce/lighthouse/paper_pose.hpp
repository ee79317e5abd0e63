// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"

namespace pharos::tools::paper002 {

/// A sensor hit by both sweeps of one cycle.
struct SensorAngles {
  std::uint8_t sensor = 0;
  Vector2 theta_rad = Vector2::Zero();
};

struct PaperPose {
  LighthouseFromBody pose;
  int iterations = 0;           ///< steps of Levenberg-Marquardt until the cost stands still
  double residual_rms = 0.0;    ///< of (6), a tangent
  bool started_by_dlt = false;  ///< else by RPnP
};

/// Section 2.3 of paper 002: DLT as start, RPnP where that has none or its descent ends far from the bearings; then
/// Levenberg-Marquardt on the residuals (6) with the Jacobian (11), unknowns (4). No outlier, second minimum or refusal
/// is looked for. Nothing for fewer than four sensors, or where no start leads to sensors ahead of the station.
std::optional<PaperPose> solve_by_paper(const Target& target, const std::vector<SensorAngles>& angles);

/// The descent alone, from a given pose.
std::optional<PaperPose> descend(const Target& target, const std::vector<SensorAngles>& angles,
                                 const LighthouseFromBody& start);

}  // namespace pharos::tools::paper002
