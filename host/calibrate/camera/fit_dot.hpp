// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "host/calibrate/camera/blobs.hpp"
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

/// A dot's image, by least squares on its grey values.
struct DotFit {
  Vector2 centre_px = Vector2::Zero();
  double sigma_px = 0.0;  // of each coordinate, from the pixels' own scatter around the fit
  double minor_px = 0.0;  // semi-axis
  double area_px2 = 0.0;
  double blur_px = 0.0;  // 1 sigma of the edge
  double misfit = 0.0;   // rms of grey values around the fit, over the dot's contrast
};

/// Fits an ellipse with a Gaussian edge, its brightness and that brightness' gradient over it, on a uniform background,
/// to every pixel within `reach` times the dot's axes. Only the edge determines the centre, as in the noise bound:
/// sigma^2 = 2 sqrt(pi) noise^2 blur / (pi radius contrast^2). The bias of the edge by blur is the same all round, and
/// perspective and lens move the centre of the ellipse as they move that of its area. Empty if the grey values are not
/// such a dot.
std::optional<DotFit> fit_dot(GreyView image, const Blob& blob, double reach);

}  // namespace pharos::calibrate
