// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/planar_rectangle.hpp"
#include "pharos/tof/relief_grid.hpp"
#include "pharos/tof/tof_settings.hpp"

namespace pharos::tof {

/// What a raised place of the plate is.
enum class BoxVerdict : std::uint8_t {
  kConnector,  ///< a box of a connector's size and shape
  kOther,      ///< a box, but longer or larger than any connector: a cover, a rail
  kUnclear,    ///< raised, but its outline is hidden, or not that of a box
  kStructure,  ///< before the satellite, or beside what is
};

/// Something with a flat top and upright sides that stands on the plate.
struct RaisedBox {
  BoxVerdict verdict = BoxVerdict::kUnclear;
  PlanarRectangle rectangle;  ///< of its top, at its height, in the axes of axes_of(normal) about the ring's centre
  double height_m = 0.0;      ///< of its top over the ring's plane
  double base_m = 0.0;        ///< of the plate around it
  /// Logarithm of the likelihood of heights as of the box over that of the plate alone.
  double log_likelihood = 0.0;

  double distance_m() const { return rectangle.centre_m.norm(); }
  double step_m() const { return height_m - base_m; }
};

/// Boxes, fragments and specks of one frame; a face has a handful.
inline constexpr std::size_t kMaxRaised = 16;

/// The plate and all that stands on it.
struct RaisedWorkspace {
  ReliefGrid grid;
  double base_m = 0.0;        ///< height of the plate inside the ring, over the ring's plane; negative
  double outer_base_m = 0.0;  ///< the same outside
  double noise_m = 0.0;       ///< of a cell's height, times the root of its weight; correlation included
  StaticVector<RaisedBox, kMaxRaised> boxes;
  bool complete = true;  ///< false: raised places are left that were not looked at
  std::array<std::uint8_t, ReliefGrid::kMaxCells> state{};
  std::array<std::uint16_t, ReliefGrid::kMaxCells> front{};
  std::array<float, ReliefGrid::kMaxCells> significance{};
};

/// Finds what stands on the plate that carries the ring, by depth alone, whatever its brightness.
///
/// Squares of 45 mm whose mean height exceeds the plate's by `min_height_m` and by four deviations are seeds. Noise is
/// measured on the frame: the scatter of such means over the plate, foil's wrinkles and correlated noise included. To
/// each seed a rectangle of any size and turn is fitted by maximum likelihood: every cell votes for the top or for the
/// plate. It is a box where no side goes on at the top's height.
void find_raised_boxes(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const ConnectorSettings& settings, RaisedWorkspace& workspace);

/// Logarithm of the likelihood that a square top of half side `half_m` stands `step_m` over the plate at a place of the
/// ring's plane, over that of the plate alone. Near zero where nothing was measured there.
double log_likelihood_of_box(const RaisedWorkspace& workspace, const RingModel& ring, int column, int row,
                             double half_m, double step_m);

}  // namespace pharos::tof
