// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/base/result.hpp"
#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::tools::paper003 {

/// A line segment in the image, pixels.
struct LineSegment {
  Vector2 begin = Vector2::Zero();
  Vector2 end = Vector2::Zero();

  double length_px() const { return (end - begin).norm(); }
  /// Of the undirected line, from +u towards +v, in [0, pi).
  double slope_rad() const;
};

/// Limits of the selection by length, slope and end points (section 3.1). The paper prints no values: these are ours,
/// one set for all images, except for the slope, which an operator sees in the image.
struct Constraints {
  std::optional<double> slope_rad;    ///< of the panel's long edges; nothing: the slope with most edge length
  double max_slope_off_rad = 0.21;    ///< 12 deg: perspective lets the two edges converge
  double min_length_fraction = 0.08;  ///< of the longest segment
  double max_end_gap_fraction = 0.2;  ///< of a short edge's length, between its end and that of a long edge
};

/// What each step of section 3.1 found.
struct Stages {
  int threshold = 0;                  ///< Otsu's, of 256 grey values
  std::vector<std::uint8_t> binary;   ///< 0 or 255, as large as the image
  std::vector<LineSegment> segments;  ///< all of LSD's
  std::vector<LineSegment> kept;      ///< long enough
  std::array<LineSegment, 2> long_edges;
  std::vector<LineSegment> short_edges;  ///< none, or both
  bool found = false;                    ///< the panel's long edges
};

enum class Failure : std::uint8_t {
  kNoContrast,      ///< one grey value: no threshold
  kNoEdges,         ///< no two segments remain that face each other
  kParallelPlanes,  ///< both edges' planes are one: no intersection
};
std::string_view name_of(Failure failure);

/// Steps of section 3.1: Otsu's threshold over the whole image, LSD on the binary image, selection.
Result<Stages, Failure> find_panel_edges(ImageView<const std::uint16_t> image, const Constraints& constraints);

/// Section 2.3: the plane of an image line by (9) and (10), in the station's frame. The camera is the paper's: one
/// focal length and a principal point, no distortion. `R_camera_station`: rows image right, image down, optical axis
/// (8).
Vector3 plane_of(const LineSegment& edge, const PinholeCamera& camera, const Matrix3& R_camera_station);

/// The panel's axis as the paper estimates it. It states no uncertainty.
struct Axis {
  Vector3 direction_station = Vector3::Zero();  ///< (12), unit
  double pitch_rad = 0.0;                       ///< (13)
  double yaw_rad = 0.0;                         ///< (14)
  /// (18): between Xt and the short side's direction in the target's body frame; nothing where its edges were not
  /// found.
  std::optional<double> square_rad;
};

/// Intersection (11)-(14), and the check of section 3.2.
Result<Axis, Failure> axis_of(const Stages& stages, const PinholeCamera& camera, double azimuth_rad,
                              double elevation_rad);

/// (17): station to target's body frame, by the axis' angles: Xt along the axis, Yt horizontal, Zt = Xt x Yt.
Matrix3 body_from_station(double pitch_rad, double yaw_rad);

}  // namespace pharos::tools::paper003
