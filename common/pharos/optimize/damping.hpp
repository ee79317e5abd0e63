// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace pharos::optimize {

/// Levenberg-Marquardt damping by Nielsen's rule (IMM-REP-1999-05), relative to the diagonal of the normal matrix. Zero
/// is the Gauss-Newton step; a damping too small to have an effect is set to zero.
class Damping {
 public:
  static constexpr double kFirst = 1e-3;   // after an undamped step that failed
  static constexpr double kMin = 1e-5;     // below it: none
  static constexpr double kMax = 1e8;      // from it on no further step is tried
  static constexpr double kMaxDrop = 3.0;  // by one step that succeeded
  static constexpr double kGrowth = 2.0;   // by the first step that failed, twice as much by each further one

  Damping() = default;
  explicit Damping(double value) : value_(value) {}

  double value() const { return value_; }
  bool none() const { return value_ == 0.0; }

  /// After a step that lowered the cost by `gain` times what the linear model predicted.
  void succeeded(double gain) {
    const double excess = 2.0 * gain - 1.0;
    value_ *= std::fmax(1.0 / kMaxDrop, 1.0 - excess * excess * excess);
    if (value_ < kMin) value_ = 0.0;
    growth_ = kGrowth;
  }

  /// After one that did not; false where the damping has reached its maximum.
  bool failed() {
    value_ = value_ > 0.0 ? value_ * growth_ : kFirst;
    growth_ *= kGrowth;
    return value_ < kMax;
  }

 private:
  double value_ = 0.0;
  double growth_ = kGrowth;
};

}  // namespace pharos::optimize
