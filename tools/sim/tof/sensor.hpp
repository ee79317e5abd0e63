// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tools/sim/random_stream.hpp"
#include "tools/sim/tof/ideal_frame.hpp"

namespace pharos::sim {

/// Noise and limits of the simulated time-of-flight sensor. One amplitude count is the unit of the intensity image.
struct SensorModel {
  double sigma_nominal_m = 0.004;  // depth noise of one pixel at nominal amplitude and kNominalRange_m
  double correlation_px = 1.5;     // distance at which the depth noise of two pixels is correlated by 1/e
  double common_sigma_m = 0.0003;  // of the whole frame
  double electrons_per_count = 1.25;
  double read_noise_counts = 15.0;
  double min_counts = 400.0;     // weaker pixels have no depth
  double full_counts = 60000.0;  // stronger ones are saturated: no depth, intensity 65535
  // The depth noise goes with the amplitude to this negative power: 1 is read noise, 0.5 shot noise.
  double noise_exponent = 1.0;
  // Pixels whose light comes from ranges with a larger deviation have no depth.
  double max_spread_m = std::numeric_limits<double>::infinity();
  // Fraction of the pixels whose depth is anything within 1 m.
  double stray_rate = 0.0;
  double range_limit_m = std::numeric_limits<double>::infinity();  // where range begins again at 0
};

/// How counts of depth are meant.
struct DepthScale {
  double scale_m = 0.00025;
  double origin_z_m = 0.0;  // from here Z counts, seen from the optical centre
};

/// What a depth camera gives: amplitude, and Z in counts of DepthScale in the raw, distorted grid (0: invalid).
struct TofPixels {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> intensity;
  std::vector<std::uint16_t> depth;
};

/// Draws noise over an ideal frame. The depth noise is proportional to the inverse of the amplitude: at equal
/// reflectance it grows with the square of the range, as sigma_nominal_m (range / kNominalRange_m)^2.
TofPixels expose(const IdealFrame& ideal, const PixelRays& rays, const SensorModel& sensor, double nominal_counts,
                 const DepthScale& scale, RandomStream random);

/// Standard normal numbers for whole images, four from one draw of 64 bits: quantiles of 2^16 equal shares, so none
/// beyond 4.4.
void fill_normal(std::vector<float>& values, RandomStream& random);

}  // namespace pharos::sim
