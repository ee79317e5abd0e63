// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/calibrate/camera/camera_calibration.hpp"
#include "tools/sim/board/board_poses.hpp"

namespace pharos::calibrate {

/// Centroid of a disk's image, summed over many small parts with the simulator's own lens model.
Vector2 true_centroid(const sim::Lens& lens, const CameraFromBoard& T_camera_board, const Board& board,
                      std::size_t index);

/// A board as found by an ideal detector, with noise of `sigma_px` in each coordinate.
FoundBoard observed(const sim::Lens& lens, const CameraFromBoard& T_camera_board, const Board& board, double sigma_px,
                    std::uint64_t seed);
ImageOutcome image_of(const FoundBoard& found);

/// fx, fy, cx, cy, k1, k2, p1, p2 and, unless fixed, k3.
std::vector<double> values_of(const PinholeCamera& camera, bool fix_k3);
std::vector<double> values_of(const sim::Lens& lens, bool fix_k3);
PinholeCamera camera_of(const sim::Lens& lens);

/// Largest error of `outcome`'s camera in sigmas, and e^T C^-1 e over its degrees of freedom.
struct Errors {
  double largest = 0.0;
  double nees = 0.0;
};
Errors errors_of(const BundleOutcome& outcome, const sim::Lens& lens, bool fix_k3);

}  // namespace pharos::calibrate
