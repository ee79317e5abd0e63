// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "pharos/geometry/pose.hpp"
#include "tools/sim/render/solid_scene.hpp"

namespace pharos::sim {

using CameraFromTarget = Pose<frame::Camera, frame::Target>;

// The simulated satellite in the target frame T: origin at the docking ring's centre in the ring's front plane, Z'
// along the ring's normal, out of the body; X' towards the first connector. Metres. Reflectances are shares of a white
// diffuse surface.

struct Ring {
  double outer_radius_m = 0.55;
  double inner_radius_m = 0.49;
  double albedo = 0.5;
};

/// A cone whose wide end looks out of the ring.
struct Nozzle {
  double exit_radius_m = 0.19;
  double exit_z_m = 0.09;
  double throat_radius_m = 0.055;
  double throat_z_m = -0.28;
  double albedo = 0.3;
};

/// A box on the body's face: a connector, or a cover, rail or antenna beside one.
struct Connector {
  double distance_m = 0.66;
  double direction_deg = 0.0;  // from X' towards Y'
  double side_m = 0.12;
  double height_m = 0.066;  // above the face
  double albedo = 0.45;
  double across_m = 0.0;  // its other side; 0: square
  double turn_deg = 0.0;  // of side_m from the direction from the ring's centre
};

/// A circle painted on the foil.
struct PaintedCircle {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.1;
  double line_m = 0.03;
  double albedo = 0.5;
};

/// Wrinkled thermal foil around the body.
struct Foil {
  double height_m = 0.004;  // standard deviation of the wrinkles' height
  double albedo = 0.20;     // its diffuse part
  double gloss = 0.25;      // broad specular part
  double glint = 3.0;       // narrow specular part, of facets that look straight at the camera
};

/// A boom before the satellite that hides `share` of the ring's circumference.
struct Occluder {
  double fraction = 1.0 / 3.0;
  double direction_deg = 180.0;  // of the hidden arc's middle, from X' towards Y'
  double width_m = 0.5;
  double nearness = 0.8;  // its distance over the ring's
  double albedo = 0.35;
};

struct Satellite {
  double body_x_m = 1.76;
  double body_y_m = 1.65;
  double body_depth_m = 1.2;
  std::optional<Ring> ring = Ring{};
  double face_z_m = -0.10;  // of the body
  std::optional<Nozzle> nozzle = Nozzle{};
  std::vector<Connector> connectors;
  std::vector<PaintedCircle> circles;
  Foil foil;
  std::optional<Occluder> occluder;
  /// What else is there, in T: a second ring, covers, thrusters, a dish, a thin boom. Of a material the albedo counts.
  std::vector<Solid> clutter;
};

/// A satellite whose every measure goes with its ring's outer diameter; two like connectors, the second one farther.
Satellite satellite_of_ring(double outer_diameter_m);

}  // namespace pharos::sim
