// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/sim/tof/pixel_rays.hpp"
#include "tools/sim/tof/scene.hpp"

namespace pharos::sim {

/// Light on the sensor before noise, row by row.
struct IdealFrame {
  std::vector<float> amplitude_counts;
  std::vector<float> range_m;     // along the ray, mean over what the pixel sees weighted by amplitude
  std::vector<float> spread_m{};  // standard deviation of the ranges that the pixel sees; empty: not known
};

/// How bright and how sharp the picture is.
struct ImagingModel {
  double nominal_counts = 8000.0;  // of kNominalReflectance at kNominalRange_m
  double blur_px = 0.5;            // standard deviation of the lens's blur, beside the pixel's own area
  double multipath = 0.2;          // amplitude of light that came round a corner
};

inline constexpr double kNominalReflectance = 0.5;
inline constexpr double kNominalRange_m = 3.16;  // paper 000, test 3

/// Casts one ray a pixel, more where neighbours met different surfaces, then blurs: amplitudes mix, and ranges mix by
/// amplitude, which makes flying pixels at edges.
IdealFrame render_ideal(const Scene& scene, const PixelRays& rays, const ImagingModel& imaging);

}  // namespace pharos::sim
