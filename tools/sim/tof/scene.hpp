// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/tof/foil_texture.hpp"
#include "tools/sim/tof/satellite.hpp"

namespace pharos::sim {

/// What a ray met. Pixels whose neighbours met something else lie on an edge.
enum class SurfaceKind : std::uint8_t {
  kSpace,
  kFace,
  kSideX,
  kSideY,
  kBack,
  kRingFront,
  kRingOutside,
  kRingInside,
  kNozzleOutside,
  kNozzleInside,
  kThroat,
  kPaint,
  kOccluder,
  kConnector,  // and one more for every further connector and face of it; then clutter, three numbers each
};

struct Hit {
  double depth_m = 0.0;      // z in the camera's frame
  double reflectance = 0.0;  // of a white diffuse surface that faces the camera
  double multipath_m = 0;    // how much farther it seems by light that came round a corner, per unit of multipath
  int surface = 0;           // SurfaceKind, as a number
};

/// A satellite before a camera: analytic intersections of the camera's rays with box, ring, nozzle and connectors.
class Scene {
 public:
  /// Keeps references: `satellite` and `foil` must outlive the scene.
  Scene(const Satellite& satellite, const FoilTexture& foil, const CameraFromTarget& T_camera_target);

  /// Which of the small parts a bundle of rays may meet. `half_angle_rad`: of the cone around `direction` (camera
  /// frame) that holds the bundle.
  using Parts = std::uint32_t;
  Parts parts_near(const Vector3& direction, double half_angle_rad) const;

  /// The first thing that the ray (x/z, y/z) from the camera meets.
  Hit trace(const Vector2& ray, Parts parts = ~Parts{0}) const;
  /// Number of the top of a connector of the satellite, as in Hit::surface.
  static int top_of_connector(std::size_t number);

 private:
  struct Ball {
    Vector3 centre_camera_m;
    double radius_m = 0.0;
  };
  struct Ray {
    Vector3 direction;  // in T; its length makes the parameter the depth
    Vector3 to_camera;  // unit
  };
  struct Boom {
    Vector2 normal = Vector2::Zero();  // of its edge in the picture x/z, y/z, towards what it hides
    double edge = 0.0;
    double width = 0.0;
    double depth_m = 0.0;
  };

  void place_boom(const Occluder& occluder);
  void trace_body(const Ray& ray, Hit& hit) const;
  void trace_ring(const Ray& ray, Hit& hit) const;
  void trace_nozzle(const Ray& ray, Hit& hit) const;
  void trace_connector(const Ray& ray, std::size_t number, Hit& hit) const;
  void trace_clutter(const Ray& ray, std::size_t number, Hit& hit) const;
  void shade_face(const Ray& ray, Hit& hit) const;
  double glossy(const Vector3& normal, const Ray& ray) const;

  const Satellite& satellite_;
  const FoilTexture& foil_;
  CameraFromTarget T_camera_target_;
  Vector3 camera_T_;          // where the camera is, in T
  double hole_radius_m_ = 0;  // of the face where the nozzle goes through it
  std::vector<Ball> balls_;   // ring and nozzle, then connectors, then clutter
  std::vector<Eigen::Matrix2d> connector_axes_;
  std::vector<Vector2> connector_centres_;
  Boom boom_;
};

}  // namespace pharos::sim
