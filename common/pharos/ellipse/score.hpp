// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ellipse/settings.hpp"
#include "pharos/ellipse/support.hpp"

namespace pharos::ellipse {

/// The three measures of paper 000, (2)-(4), each from 0 to 1.
struct Score {
  double shape = 0.0;     ///< S1: 1 where a/b is below the threshold
  double accuracy = 0.0;  ///< S2: mean of 1 - 0.3 L_i
  double fullness = 0.0;  /// S3: half the fraction of the contour's length, half that of its turn
  /// F_val = S1 sqrt(S2 S3)
  double value() const;
};

Score score_of(const Ellipse& ellipse, const Support& support, const EllipseSettings& settings);

}  // namespace pharos::ellipse
