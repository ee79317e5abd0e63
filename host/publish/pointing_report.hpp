// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "pharos/geometry/types.hpp"

namespace pharos::host {

/// One telescope image's axis, or that of a pass: what pointing_t is made of.
struct PointingReport {
  std::int64_t utc_ns = 0;  // of the image as its track tells it; of a pass its middle
  std::int64_t sequence = 0;
  std::string source;
  std::string camera;
  std::string target;
  std::string flags;  // words joined by '|'
  /// Where there is no axis: why, as the `<reason>` of refused_<reason>; empty where there is one.
  std::string refusal;
  bool ambiguous = false;
  bool from_pass = false;
  int images = 1;
  Vector3 axis_station = Vector3::Zero();
  Vector3 axis_earth = Vector3::Zero();
  Matrix3 covariance_station = Matrix3::Zero();
  Vector3 plane_normal_station = Vector3::Zero();  // of one image; zero for a pass
  double sigma_plane_rad = 0.0;
};

}  // namespace pharos::host
