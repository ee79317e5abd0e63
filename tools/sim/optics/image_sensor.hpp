// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/images/grey_image.hpp"
#include "tools/sim/optics/linear_image.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// The sensor of all simulated grey images: light to electrons to counts.
struct ImageSensor {
  double full_well_e = 10000.0;
  double read_noise_e = 6.0;
  /// Electrons for light 1 in one exposure: by default such light fills 80 % of the well. For a scene with another peak
  /// in good light use 0.8 * full_well_e / peak_light(good). Low light is the same scene with weaker lights and the
  /// same value.
  double electrons_per_light = 8000.0;
  int bits = 8;  ///< of the counts: 8 or 16; a full well is the largest
  bool shot_noise = true;
};

/// The 99.9 % quantile of the light, which glints do not affect; with `lit_only` only of pixels with light. 0 without
/// pixels.
double peak_light(const LinearImage& image, bool lit_only = false);

/// One exposure: shot noise, a well that overflows, read noise, rounding to counts. The pixels are 16-bit values as
/// read_grey_image would give them (8 bits: count * 257).
host::GreyImage expose(const LinearImage& image, const ImageSensor& sensor, RandomStream& random);

}  // namespace pharos::sim
