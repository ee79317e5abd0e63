// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/pointing/measure_panel.hpp"

namespace pharos::pointing {

/// What an unknown tone curve may do to an axis.
///
/// A camera whose grey values are no multiple of the light moves every edge before the sky by the same fraction of its
/// blur, outwards or inwards; sides that converge then meet elsewhere. Where two ends are seen, the right angle between
/// them and the sides tells how large that fraction may be.
struct ToneError {
  Vector3 shift = Vector3::Zero();  ///< of the axis, rad, along its plane, in C, for what tone curves usually do
  double sigma = 1.0;               ///< of that, after the right angle
};

/// Zero where perspective hardly tells the axis.
ToneError tone_error(const PanelMeasurement& panel);

}  // namespace pharos::pointing
