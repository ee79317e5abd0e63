// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/fusion/filter.hpp"

namespace pharos::fusion {

/// What an excluded source has shown since it last disagreed: measurements in a row that agree with a solution.
struct Proof {
  int count = 0;
  std::int64_t since_ns = 0;
  double nis = 0.0;  // sum over all of them, of `dof` degrees of freedom
  int dof = 0;
  Vector6 mean = Vector6::Zero();  // of their residuals, vehicle frame
  double scatter = 0.0;            // of the residuals about their mean: chi-squared of `scatter_dof`
  int scatter_dof = 0;
  unsigned sides = 0;  // in a conflict: bits, the sides that every one fitted

  /// One more, of a source that has no pose of its own to compare.
  void add(std::int64_t time_ns);
  /// One more, and what it left. `innovation`: with the source's bias as unknown as before its first measurement.
  void add(const Innovation& innovation, const TargetMeasurement& measurement);
  /// For as long as a readmission takes.
  bool long_enough(std::int64_t time_ns, const DetectionSettings& detection) const;
  /// Whether they are noise about one offset, and that offset is one that the covariance of what is common to all of
  /// them (the source's slow error, the solution's own error) allows. Each one alone passed its gate, but the errors
  /// that they share are one draw and not `count` draws. `last`, `measurement`: the newest.
  bool is_sound(const Innovation& last, const TargetMeasurement& measurement) const;
  /// For the choice between two solutions of which they fit one only: that one's own error, which lasts, may be in it.
  bool fits_beside() const;
};

}  // namespace pharos::fusion
