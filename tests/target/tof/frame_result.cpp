// SPDX-License-Identifier: Apache-2.0
#include "tests/target/tof/frame_result.hpp"

#include "tests/target/vectors/result_line.hpp"

namespace pharos::test {
namespace {

void print(const tof::CameraFromTarget& pose) {
  ResultLine line("tof_pose");
  for (int k = 0; k < 3; ++k) line << pose.t[k];
  for (int k = 0; k < 9; ++k) line << pose.R(k / 3, k % 3);
}

void print(const Matrix6& covariance) {
  ResultLine line("tof_covariance");
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) line << covariance(row, column);
  }
}

}  // namespace

void print_result(const Result<tof::TofPose, tof::TofFailure>& result, const tof::TofWorkspace& workspace) {
  const ellipse::EllipseCounters& seen = workspace.ellipse.counters;
  ResultLine("tof_edges") << seen.edge_points << seen.contours << seen.arcs << seen.candidates;
  for (const ellipse::DetectedEllipse& found : workspace.ellipse.found) {
    ResultLine("tof_ellipse") << found.points << found.arcs << found.bright_inside << found.ellipse.cx_px
                              << found.ellipse.cy_px << found.ellipse.a_px << found.ellipse.b_px;
  }
  if (!result) {
    ResultLine("tof_failure") << static_cast<int>(result.error());
    return;
  }
  const tof::RingFit& ring = result->ring.fit;
  ResultLine("tof_ring") << ring.edge_points << ring.plane_pixels << ring.model.radius_m[0] << ring.model.radius_m[1];
  for (const tof::RaisedBox& box : workspace.raised.boxes) {
    ResultLine("tof_box") << static_cast<int>(box.verdict) << box.rectangle.centre_m.x() << box.rectangle.centre_m.y()
                          << box.rectangle.half_sides_m.x() << box.rectangle.half_sides_m.y() << box.height_m;
  }
  ResultLine("tof_connector") << result->connector.edge_points << result->connector.rectangle.centre_m.x()
                              << result->connector.rectangle.centre_m.y() << result->connector.height_m;
  ResultLine("tof_flags") << result->flags << result->ambiguous();
  print(result->target.pose);
  print(result->target.covariance);
}

}  // namespace pharos::test
