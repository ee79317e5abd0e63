// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/mounting/mounting.hpp"
#include "pharos/fusion/settings.hpp"

namespace pharos::tools {

/// What the command line says of the fusion.
struct FuseChoices {
  std::string motion = "free";  // free, orbit, tumbling, tumbling_orbit
  double mean_motion_rad_s = 0.0011;
  std::vector<double> inertia{1.0, 1.0, 1.0};
  double acceleration_density = 1e-6;
  double angular_acceleration_density = 1e-8;
  double bias_deg = 0.05;  // of every source beside its mounting
  double bias_mm = 1.0;
  double bias_time_s = 60.0;
  double risk_per_hour = 1e-5;
  double faults_per_hour = 1e-3;  // of each kind and source
};

/// Settings without sources.
fusion::Settings fusion_settings(const FuseChoices& choices);

/// One source of the mounting file. Its bias is what its mounting's covariance leaves at `first`, a pose as the source
/// reports it, and the source's own; an unknown feature makes it a relative source.
fusion::SourceSettings fused_source(const host::SourceMounting& mounting, const host::SensorFromFeature& first,
                                    const FuseChoices& choices);

}  // namespace pharos::tools
