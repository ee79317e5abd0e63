// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluate/position_comparison.hpp"
#include "tools/evaluation/reproduce/stations/positioning_log.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// What one plane of a station leaves in one direction.
struct ResidualCell {
  std::string log, geometry;
  int station = 0;           // its number
  std::string plane;         // x or y, a or b
  double azimuth_deg = 0.0;  // middle of the cell in the station's frame: to the right, down
  double elevation_deg = 0.0;
  std::size_t sweeps = 0;
  double mean_rad = 0.0, rms_rad = 0.0;
};

/// Sweeps' mean angles against the motion capture, in cells of 5 deg: measured less what the plane shows of the body at
/// its true place (in the world as `comparison` aligns it) and in the tracked attitude. At rest it says nothing, as
/// the frames are open then: empty.
std::vector<ResidualCell> residual_map(const PositioningLog& log, const std::string& geometry,
                                       const network::Stations& stations, const evaluate::PositionTrack& tracked,
                                       const evaluate::PositionComparison& comparison);

/// `log,geometry,station,plane,azimuth_deg,elevation_deg,sweeps,mean_arcsec,rms_arcsec`.
void write_residual_map(const std::vector<ResidualCell>& cells, const std::string& path);

}  // namespace pharos::tools
