// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/vision/pointing/pointing_refusal.hpp"
#include "host/vision/pointing/segment.hpp"
#include "pharos/base/flag_word.hpp"
#include "pharos/base/result.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/station.hpp"

namespace pharos::pointing {

/// Flags of an image's result.
enum PointingFlag : std::uint8_t {
  /// A single panel: no second one in line determines which of its sides is the axis.
  kFlagOnePanel = 1U << 0U,
  /// The axis is not determined within the plane (sigma above 20 deg): only the plane is.
  kFlagPlaneOnly = 1U << 1U,
  /// Long and short side are not at right angles by more than 3 sigma and 0.5 deg: not the sides of one rectangle.
  kFlagNotSquare = 1U << 2U,
  /// A second panel extends beyond the image and was not used.
  kFlagPanelCut = 1U << 3U,
};
inline constexpr std::array<FlagWord, 4> kPointingFlagWords = {{{kFlagOnePanel, "one_panel"},
                                                                {kFlagPlaneOnly, "plane_only"},
                                                                {kFlagNotSquare, "not_square"},
                                                                {kFlagPanelCut, "panel_cut"}}};

/// The edges of a panel or of a wing's two, measured in one image. Planes are in frame C.
struct PanelMeasurement {
  pointing::AxisPlanes long_planes;
  pointing::AxisPlanes short_planes;
  /// The same edges, moved outwards by what an unknown tone curve may move them (1 sigma).
  pointing::AxisPlanes long_planes_moved;
  pointing::AxisPlanes short_planes_moved;
  pointing::AxisPlanes other_planes;  ///< long sides of what may as well be the panel; empty where nothing else may
  std::vector<Segment> long_edges;    ///< in the ideal image, for pictures
  std::vector<Segment> short_edges;
  std::vector<Segment> outline;  ///< every edge of the outline, in the distorted image
  int panels = 0;
  double rms_px = 0.0;   ///< of the long edges' points
  double blur_px = 0.0;  ///< sigma of their rise from sky to panel
  std::uint8_t flags = 0;
};

/// The image processing of paper 003 (2.1): Otsu's threshold, segments, the panel's edges among them, each refitted on
/// the grey image. Throws host::InputError where OpenCV's module is missing.
Result<PanelMeasurement, PointingRefusal> measure_panel(ImageView<const std::uint16_t> image,
                                                        const PinholeCamera& camera);

/// Axis and plane of one image in S.
struct PointingResult {
  pointing::AxisEstimate axis;  ///< with its sign (signed_axis)
  pointing::AxisPlanes planes_station;
  /// The axis of what may as well be the panel: the answer is ambiguous.
  std::optional<Vector3> second_axis;
  /// Angle between long and short side (paper 003, 3.2), and its sigma; where a short edge was seen.
  std::optional<double> square_rad;
  double sigma_square_rad = 0.0;
  std::uint8_t flags = 0;
};
/// How grey values follow the light.
enum class Tone : std::uint8_t {
  kLinear,   // a sensor's own values
  kUnknown,  // they may be a power of the light, as those for screens are
};
/// Values of 16 bits are taken for a sensor's own, those of 8 bits for what may have been made for screens.
inline Tone tone_of_bits(int bits) { return bits > 8 ? Tone::kLinear : Tone::kUnknown; }

PointingResult answer_of(const PanelMeasurement& panel, const pointing::LineOfSight& sight, Tone tone);

}  // namespace pharos::pointing
