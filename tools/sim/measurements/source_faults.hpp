// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/measurements/measured_world.hpp"

namespace pharos::sim {

/// Makes one source's poses wrong from the fault's beginning on.
class SourceFaultMaker {
 public:
  SourceFaultMaker(const SourceFault& fault, const MeasuredSource& source, std::uint64_t seed);

  /// Changes `pose`, which was measured at pose.time_s and belongs to the source.
  void apply(SimulatedPose& pose);

 private:
  void shift(SimulatedPose& pose, const Vector6& direction, double size) const;
  void mirror(SimulatedPose& pose) const;

  SourceFault fault_;
  const MeasuredSource& source_;
  RandomStream random_;
  Vector6 direction_;
  double ramp_s_;
  double sign_;
  bool half_turn_;
  WorldSensorPose other_;
  std::optional<WorldSensorPose> frozen_;
};

}  // namespace pharos::sim
