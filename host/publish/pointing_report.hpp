// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::host {

/// One telescope image's axis, or that of a pass: what pointing_t is made of. Its time is that of the image as its
/// track tells it, of a pass its middle; no age is told.
struct PointingReport : MeasurementHeader {
  PointingReport() { frames = {"station", "target"}; }

  bool from_pass = false;
  int images = 1;
  Vector3 axis_station = Vector3::Zero();
  Vector3 axis_earth = Vector3::Zero();
  Matrix3 covariance_station = Matrix3::Zero();
  Vector3 plane_normal_station = Vector3::Zero();  // of one image; zero for a pass
  double sigma_plane_rad = 0.0;
};

const char* channel_of(const PointingReport& report);
bool is_finite(const PointingReport& report);

}  // namespace pharos::host
