// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/ellipse/settings.hpp"
#include "pharos/tof/target_description.hpp"

namespace pharos::tof {

/// Prior knowledge of the docking ring. Limits, not values: the ring is measured, not assumed.
struct RingSettings {
  /// Rings between 0.6 and 1.2 m across are in use; a nozzle's rim is smaller. Metres.
  double min_outer_radius_m = 0.25;
  double max_outer_radius_m = 0.75;
  /// Inner over outer radius.
  double min_radius_ratio = 0.6;
  double max_radius_ratio = 0.97;
  /// Fraction of the ring's circumference that must be seen with depth on its plane. A third may be hidden (0.65 is
  /// left); of 8,400 such frames one had 0.54, its plane 6 deg off where 0.6 deg were stated.
  double min_seen = 0.6;
  /// Minimum depth of the surroundings behind the ring's plane, inside and outside: a painted circle has no step.
  /// Metres.
  double min_step_m = 0.015;
};

/// Noise of the depth camera, only for gates: the reported covariance is measured on the frame itself.
struct DepthNoise {
  /// Standard deviation of one pixel at `range_m`; grows with the range's square.
  double sigma_m = 0.004;
  double range_m = 3.16;
  /// Common to all pixels of a frame: averaging does not reduce it, so it is added to the covariance.
  double common_sigma_m = 0.0003;
};

/// Local threshold (5): by the window's pixel count (Niblack's own form), or divided by its mean as printed.
enum class ThresholdForm : std::uint8_t { kPixelCount, kAsPrinted };

/// Limits of paper 000, section 2.2.2.
struct ConnectorSettings {
  ThresholdForm form = ThresholdForm::kPixelCount;
  /// Half the window's width, w of (5), is the larger of the paper's 4 and this fraction of the outer ellipse's
  /// semi-axis: where the window does not reach beyond the connector, half of its flat face lies below its own mean.
  std::int32_t min_half_window_px = 4;
  double window_fraction = 0.2;
  /// Only pixels as bright as this fraction of the ring are marked: dark foil's depths are noise.
  double min_amplitude = 0.4;
  double min_area_px = 20.0;
  /// Minimum and maximum area over that of the outer ellipse: patches of noise reach a third of the minimum.
  double min_area_fraction = 0.005;
  double max_area_fraction = 0.1;
  double min_aspect = 0.7;
  double max_aspect = 1.5;
  double min_fill = 0.7;
  /// Both sides of a connector are at least this long. Metres.
  double min_side_m = 0.04;
  /// Search radius for connectors from the ring's centre, in outer radii.
  double reach = 1.7;
  /// Minimum height of its face over its surroundings, m.
  double min_height_m = 0.015;
  /// Number of connectors that the target carries; the paper's has two. Where fewer are seen the nearest may be the
  /// missing one, and the turn about Z' is not reported.
  std::int32_t expected = 2;
  /// Two whose distances differ by less are equally near: neither may be chosen. Metres.
  double min_difference_m = 0.008;
};

struct TofSettings {
  /// Of rings and connectors; small dots are not searched, which saves their time.
  ellipse::EllipseSettings ellipse{.min_minor_px = 4.0};
  RingSettings ring;
  DepthNoise noise;
  ConnectorSettings connector;
  TargetDescription target;
};

}  // namespace pharos::tof
