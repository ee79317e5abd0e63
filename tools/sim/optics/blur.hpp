// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/sim/optics/linear_image.hpp"

namespace pharos::sim {

/// Half of a symmetric kernel: the weights of the pixels 0, 1, 2, ... from its middle. The whole sums to 1.
using Kernel = std::vector<float>;

/// A Gaussian of `sigma_px` integrated over each pixel, as a sensor's pixels do: the pixel's own width comes on top
/// (variance sigma^2 + 1/12). 0: no blur.
Kernel gaussian_over_pixels(double sigma_px);
/// A Gaussian of `sigma_px` at the pixels' centres: for images that are averages over pixels already, and for noise
/// that shall be correlated by exp(-distance^2 / (4 sigma^2)). 0: no blur.
Kernel gaussian_at_pixels(double sigma_px);

/// Factor by which convolve() reduces the variance of white noise.
double variance_ratio(const Kernel& kernel);

/// Convolves an image with the kernel, horizontally and vertically, in place. The outermost pixels continue beyond the
/// border.
void convolve(std::vector<float>& pixels, int width_px, int height_px, const Kernel& kernel);

/// Optics or seeing: gaussian_over_pixels.
LinearImage blurred(const LinearImage& image, double sigma_px);

}  // namespace pharos::sim
