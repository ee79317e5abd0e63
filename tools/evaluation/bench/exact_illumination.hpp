// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/enhance/smoothness.hpp"

namespace pharos::tools {

/// The solution of (5) of paper 004 by sparse Cholesky factors in double precision (Eigen's SimplicialLDLT): takes
/// seconds for a frame; the reference for faster solvers.
enhance::FloatImage exact_illumination(const enhance::SmoothnessSystem& system, const enhance::FloatImage& start);

/// RMS difference of two illuminations, as a fraction of the range of `exact`.
double rms_of_range(const enhance::FloatImage& found, const enhance::FloatImage& exact);

}  // namespace pharos::tools
