// SPDX-License-Identifier: Apache-2.0
// Any pixels as an image for ellipse detection: results are finite, within the settings, and repeatable.
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "pharos/ellipse/detect.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::require;
using namespace pharos::ellipse;

// The first byte gives the width and the scaling of values to 16 bits; the others are pixels, repeated to fill the last
// row.
std::vector<std::uint16_t> pixels_of(const std::uint8_t* data, std::size_t size, int width, bool steep) {
  std::vector<std::uint16_t> pixels;
  for (std::size_t k = 0; k < size || pixels.size() % static_cast<std::size_t>(width) != 0; ++k) {
    const std::uint16_t byte = data[k % size];
    pixels.push_back(static_cast<std::uint16_t>(steep ? byte * 257 : byte));
  }
  return pixels;
}

void check(const DetectedEllipse& found, const EllipseSettings& settings) {
  const Ellipse& e = found.ellipse;
  require(std::isfinite(e.cx_px) && std::isfinite(e.cy_px) && found.covariance.allFinite());
  require(e.b_px >= settings.min_minor_px && e.a_px >= e.b_px && e.a_px < settings.max_axis_ratio * e.b_px);
  require(e.theta_rad > -1.5708 && e.theta_rad <= 1.5708);
  require(found.score >= settings.min_score && found.score <= 1.0 && found.coverage >= 0.0 && found.coverage <= 1.0);
  for (int k = 0; k < 5; ++k) require(found.covariance(k, k) >= 0.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > 65536) return 0;
  const int width = 8 + data[0] % 128;
  const std::vector<std::uint16_t> pixels = pixels_of(data + 1, size - 1, width, data[0] >= 128);
  const auto height = static_cast<std::int32_t>(pixels.size() / static_cast<std::size_t>(width));
  static std::vector<std::uint16_t> planes;
  planes.resize(kPlanes * pixels.size());
  static const auto workspace = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
  workspace->planes = planes;
  EllipseSettings settings;
  settings.min_score = 0.2;  // so that more candidates reach this stage
  const pharos::ImageView<const std::uint16_t> image(pixels.data(), width, height);
  std::vector<DetectedEllipse> first;
  for (const DetectedEllipse& found : detect_ellipses(image, settings, *workspace)) {
    check(found, settings);
    first.push_back(found);
  }
  const auto again = detect_ellipses(image, settings, *workspace);
  require(again.size() == first.size());
  for (std::size_t k = 0; k < first.size(); ++k) require(again[k].ellipse.a_px == first[k].ellipse.a_px);
  return 0;
}
