// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ring2/solve.hpp"

namespace pharos::ring2 {

/// Paper 001 as published, with the repairs that its print needs (README.md names them). A reference: it carries no
/// covariance (zero) and has the model's own error. Needs all four ellipses. It takes neither a start nor a refusal
/// from solve_ring2: ellipses that do not fit together are answered too, as in print.
Result<Ring2Estimate, Ring2Failure> solve_ring2_by_paper(const Rig& rig, const ContourSet& contours);

/// The attitudes of which (19) and (24) take the mean.
struct PaperAttitudes {
  std::array<Attitude, kViews> camera;  ///< (10) to (18), (20) to (23) with one camera alone, in the rig's frame
  Attitude both;
  double distance_m = 0.0;  ///< (9), mean of both cameras
};
/// Figure 9 compares `both` with the left camera's.
Result<PaperAttitudes, Ring2Failure> paper_attitudes(const Rig& rig, const ContourSet& contours);

/// Prior knowledge of the monocular variant.
struct KnownSizes {
  double ring_radius_m = 0.0;
  double nozzle_radius_m = 0.0;
  double distance_m = 0.0;
};

/// The monocular variant that the paper compares with (its reference 10): one camera, known sizes, the ellipses'
/// centres taken for the images of the circles' centres.
Result<Attitude, Ring2Failure> attitude_by_one_camera(const RigView& view, const Contour& ring, const Contour& nozzle,
                                                      const KnownSizes& sizes);

/// The triangle of figures 4 and 5 in one plane of the camera: the target's axis A B seen from C. All angles signed
/// from the optical axis towards the plane's first axis (x or y).
struct PlaneTriangle {
  double beta1_rad = 0.0;  ///< (2): of the line of sight to the ring's centre A
  double beta2_rad = 0.0;  ///< (3): to the nozzle's centre B
  double CD_m = 0.0;       ///< (4): depth of A
  double CE_m = 0.0;       ///< (5): depth of B
};
/// d of (8) and (9).
double distance_by_paper(const PlaneTriangle& triangle);
/// gamma_1 of (12), (15), (18), or theta_1 of (23): the angle of A B, from the direction towards the camera.
double axis_angle_by_paper(const PlaneTriangle& triangle, double distance_m);

}  // namespace pharos::ring2
