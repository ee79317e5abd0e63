// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/camera/depth_camera.hpp"
#include "pharos/tof/tof_frame.hpp"

namespace pharos::tof {

/// Where pixels look, with the lens' distortion undone: exact at every fourth pixel, bilinear between. The greatest
/// error of a wide lens (|k1| 0.2 at 40 deg off axis) is 0.003 px. Made once a camera: some 4 ms.
class RayGrid {
 public:
  /// Refuses cameras that are unusable, larger than the workspace, or whose lens folds inside the image. Cheap where
  /// `camera` is the one that it already stands for.
  bool prepare(const PinholeCamera& camera);

  /// Ray (x/z, y/z) of a pixel position in the image.
  Vector2 at(double u_px, double v_px) const;

  /// Rays of one row's pixels, for work on whole images: of `count` pixels from (u, v) on, in single precision.
  struct Row {
    std::array<float, kMaxWidth_px> x;
    std::array<float, kMaxWidth_px> y;
  };
  void row_at(std::int32_t u, std::int32_t v, std::int32_t count, Row& row) const;

  const PinholeCamera& camera() const { return camera_; }

 private:
  static constexpr int kStep_px = 4;
  static constexpr int kColumns = kMaxWidth_px / kStep_px + 2;
  static constexpr int kRows = kMaxHeight_px / kStep_px + 2;

  struct Node {
    double x = 0.0;
    double y = 0.0;
  };
  PinholeCamera camera_;
  bool ready_ = false;
  int columns_ = 0;
  int rows_ = 0;
  std::array<Node, static_cast<std::size_t>(kColumns* kRows)> nodes_{};
};

}  // namespace pharos::tof
