// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::host {

/// One telescope image's axis, or that of a pass: content of a pointing_t. Its time is that of the image in its track
/// file, for a pass the middle; no age is reported.
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
