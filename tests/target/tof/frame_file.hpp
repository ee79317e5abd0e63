// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/camera/depth_camera.hpp"
#include "pharos/tof/tof_frame.hpp"

namespace pharos::test {

// Memory layout of one frame and its camera (little-endian, doubles aligned to 8 bytes, on both sides): the host writes
// the file, QEMU's generic loader puts it into memory before the target's program starts.
inline constexpr std::uintptr_t kFrameAddress = 0x82000000;
inline constexpr std::uint64_t kFrameMagic = 0x464F5450;  // "PTOF"

struct FrameFile {
  std::uint64_t magic = kFrameMagic;
  double fx_px = 0.0, fy_px = 0.0, cx_px = 0.0, cy_px = 0.0;
  std::array<double, 5> distortion{};
  double depth_scale_m = 0.0;
  double depth_origin_z_m = 0.0;
  std::array<std::uint16_t, tof::kMaxPixels> intensity{};
  std::array<std::uint16_t, tof::kMaxPixels> depth{};

  DepthCamera camera() const {
    DepthCamera camera;
    camera.intrinsics = {tof::kMaxWidth_px, tof::kMaxHeight_px, fx_px, fy_px, cx_px, cy_px, distortion};
    camera.depth_scale_m = depth_scale_m;
    camera.depth_origin_z_m = depth_origin_z_m;
    return camera;
  }
  tof::TofFrame frame() const {
    return {{intensity.data(), tof::kMaxWidth_px, tof::kMaxHeight_px},
            {depth.data(), tof::kMaxWidth_px, tof::kMaxHeight_px}};
  }
};

}  // namespace pharos::test
