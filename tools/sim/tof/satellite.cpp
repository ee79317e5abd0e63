// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/satellite.hpp"

namespace pharos::sim {

Satellite satellite_of_ring(double outer_diameter_m) {
  const double d = outer_diameter_m;
  Satellite satellite;
  satellite.body_x_m = 1.6 * d;
  satellite.body_y_m = 1.5 * d;
  satellite.body_depth_m = 1.1 * d;
  satellite.face_z_m = -0.09 * d;
  satellite.ring = Ring{.outer_radius_m = 0.5 * d, .inner_radius_m = 0.445 * d};
  satellite.nozzle =
      Nozzle{.exit_radius_m = 0.17 * d, .exit_z_m = 0.08 * d, .throat_radius_m = 0.05 * d, .throat_z_m = -0.25 * d};
  satellite.connectors = {
      Connector{.distance_m = 0.60 * d, .direction_deg = 0.0, .side_m = 0.11 * d, .height_m = 0.06 * d},
      Connector{.distance_m = 0.66 * d, .direction_deg = 75.0, .side_m = 0.11 * d, .height_m = 0.06 * d}};
  return satellite;
}

}  // namespace pharos::sim
