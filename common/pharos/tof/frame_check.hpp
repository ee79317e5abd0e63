// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "pharos/camera/depth_camera.hpp"
#include "pharos/tof/tof_failure.hpp"
#include "pharos/tof/tof_frame.hpp"

namespace pharos::tof {

/// Rejects unusable frames before any processing. It stores the last frame's rows: a buffer that was only partly
/// written has rows that are equal to the last bit, which noise never produces.
class FrameCheck {
 public:
  /// The first defect, if any.
  std::optional<TofFailure> check(const TofFrame& frame, const DepthCamera& camera);

 private:
  std::array<std::uint64_t, static_cast<std::size_t>(kMaxHeight_px)> rows_{};  // 0: empty row
  std::int32_t height_px_ = 0;
};

}  // namespace pharos::tof
