// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/motion/hypothesis.hpp"

namespace pharos::motion {

/// The best hypothesis of a track with its coplanar sensors tilted to the other side (Tilt), while they are tilted so
/// little that the side may be lost. Where the stated covariance holds both attitudes, they are one; where they part,
/// the body may have gone on to either side, and both take every sweep until their perspective tells which.
class MirroredTilt {
 public:
  /// `best` has taken this sweep. `may_swap`: the mirrored one may take its place (true is returned where it did).
  bool push(Hypothesis& best, const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
            const AssumedNoise& noise, bool may_swap);
  /// The second solution of the first cycle.
  void begin(const Hypothesis& second);
  /// The best hypothesis begins anew.
  void reset();
  /// Another one of the same body took its place.
  void renew() { mirrored_.reset(); }

  /// There is one, and what the best one states does not hold it.
  bool apart(const Hypothesis& best) const;
  const Hypothesis& hypothesis() const { return *mirrored_; }
  /// Its chi-squared minus the best one's, as far as perspective tells.
  double delta_chi2() const { return delta_chi2_; }

 private:
  void judge(const Hypothesis& best);

  std::optional<Hypothesis> mirrored_;
  double delta_chi2_ = 0.0;
  bool open_ = false;
};

}  // namespace pharos::motion
