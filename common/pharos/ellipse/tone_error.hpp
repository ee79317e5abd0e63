// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/image_view.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// By how much of an edge's blur (1 sigma, in the light) a square-root tone curve moves it towards its darker side;
/// `contrast`: difference of the grey values beside it over their sum.
///
/// The half level of the grey values y is where light y^2 has risen by (3 y_dark + y_bright) / 4 (y_dark + y_bright) =
/// 1/2 - contrast / 4 of its step, and so a normal edge has its half level at the quantile of that: 0.67 before black.
/// Within 5 % this is the steepest place too, as the filter shows it, of blurs to 1.6 px.
double tone_shift(double contrast);

/// Widens the covariances of `workspace.found` by what an unknown tone curve may do to their contours.
///
/// Cameras for people write grey values that are a power of the light, 0.45 to 0.6; then every bright shape grows by a
/// part of the blur, which no scatter tells. The shift of a square root (0.8 to 1.15 times as much for 0.6 and 0.45) is
/// taken for one sigma, of all places of a contour together; blur and contrast are measured along its normals. For
/// images of which nobody says that their values are linear in light: those of 8 bits.
///
/// `image` is the one of the last detect_ellipses.
void add_tone_error(ImageView<const std::uint16_t> image, EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
