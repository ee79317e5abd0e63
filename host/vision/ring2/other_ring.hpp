// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// Whether an image shows the face of another ring, about as large as this one or larger, beside it: two concentric
/// ellipses as far apart as the edges of a rim. It need not have a nozzle and need not be in both images; then it is no
/// hypothesis of its own, and nothing says which ring is the docking ring.
bool shows_another_ring(const ring2::Rig& rig,
                        const std::array<std::vector<ellipse::DetectedEllipse>, ring2::kViews>& found,
                        const ring2::Ring2Estimate& estimate);

}  // namespace pharos::host
