// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "pharos/ellipse/detect.hpp"
#include "tools/evaluation/problems/ring_images.hpp"

namespace pharos::ellipse {

/// The detector with memory for one size of image.
struct Bench {
  explicit Bench(std::size_t pixels = 640 * 480) : planes(kPlanes * pixels) { workspace->planes = planes; }

  std::vector<test::TrueEllipse> detect(const std::vector<std::uint16_t>& pixels, int width, int height,
                                        const EllipseSettings& settings = {}) {
    std::vector<test::TrueEllipse> ellipses;
    for (const DetectedEllipse& found : detect_ellipses({pixels.data(), width, height}, settings, *workspace)) {
      const Ellipse& e = found.ellipse;
      ellipses.push_back({e.cx_px, e.cy_px, e.a_px, e.b_px, e.theta_rad});
    }
    return ellipses;
  }

  std::vector<std::uint16_t> planes;
  std::unique_ptr<EllipseWorkspace> workspace = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
};

/// Score over `images` rendered frames.
inline test::RingScore score_on(const test::RingSet& set, int images, std::uint64_t seed) {
  Bench bench(static_cast<std::size_t>(set.camera.width_px * set.camera.height_px));
  test::RingGenerator generator(set, seed);
  test::RingScore score;
  for (int k = 0; k < images; ++k) {
    const test::RingImage image = generator.next();
    score.add(image, bench.detect(image.pixels, set.camera.width_px, set.camera.height_px));
  }
  return score;
}

inline double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace pharos::ellipse
