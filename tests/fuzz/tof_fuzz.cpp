// SPDX-License-Identifier: Apache-2.0
// Any frame: the pipeline returns, and a pose is finite and has a covariance. The bytes are rectangles of any value
// painted over a frame with a ring, in either image, and changes of the camera model.
#include <cstdlib>
#include <memory>

#include "pharos/tof/tof_pose.hpp"
#include "support/synthetic_ring.hpp"

namespace {

using namespace pharos;  // NOLINT(google-build-using-namespace)

DepthCamera tiny_camera() {
  DepthCamera camera;
  camera.intrinsics = {160, 120, 152.0, 151.0, 80.4, 59.7, {-0.1991, 0.0809, 0.0021, -0.0002, 0.0}};
  return camera;
}

const test::SyntheticFrame& ring_frame() {
  static const test::SyntheticFrame kFrame =
      test::render(test::SyntheticRing{}, test::facing({0.02, 0.0, 2.3}, {0.2, 0.1, 0.4}), tiny_camera());
  return kFrame;
}

// left, top, width, height, value (16 bits), which image and how.
constexpr std::size_t kBrushBytes = 7;

void paint(test::SyntheticFrame& frame, const std::uint8_t* brush) {
  const auto value = static_cast<std::uint16_t>(brush[4] << 8 | brush[5]);
  std::vector<std::uint16_t>& image = (brush[6] & 1) != 0 ? frame.depth : frame.intensity;
  const bool add = (brush[6] & 2) != 0;
  for (int v = brush[1]; v < brush[1] + brush[3] && v < frame.height_px; ++v) {
    for (int u = brush[0]; u < brush[0] + brush[2] && u < frame.width_px; ++u) {
      std::uint16_t& pixel = image[static_cast<std::size_t>(v * frame.width_px + u)];
      pixel = static_cast<std::uint16_t>(add ? pixel + value : value);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto kWorkspace = std::make_unique<tof::TofWorkspace>();
  test::SyntheticFrame frame = ring_frame();
  DepthCamera camera = tiny_camera();
  if (size > 0 && data[0] != 0) {
    camera.intrinsics.distortion[data[0] % 5] += 0.05 * static_cast<std::int8_t>(data[0]);
    camera.depth_scale_m *= 1.0 + data[0] / 16;
  }
  for (std::size_t at = 1; at + kBrushBytes <= size && at < 64 * kBrushBytes; at += kBrushBytes)
    paint(frame, data + at);
  const auto pose = tof::measure_tof_pose(frame.view(), camera, tof::TofSettings{}, *kWorkspace);
  if (!pose) return 0;
  if (!pose->target.pose.is_finite() || !pose->target.covariance.allFinite()) std::abort();
  if (!(pose->target.covariance.diagonal().array() > 0.0).all()) std::abort();
  if (std::fabs(pose->target.pose.R.determinant() - 1.0) > 1e-9) std::abort();
  if (!(pose->target.pose.t.z() > 0.0)) std::abort();
  return 0;
}
