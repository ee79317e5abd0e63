// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/tone_error.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "pharos/geometry/rotation.hpp"
#include "support/painted_panel.hpp"
#include "tools/sim/optics/tone_curve.hpp"

namespace pharos::pointing {
namespace {

// A panel 2 m wide at 40 m, its far end a tenth farther than its near one.
testing::PaintedPanel slanted_panel(int k) {
  testing::PaintedPanel panel;
  panel.camera.fx_px = panel.camera.fy_px = 1200.0;
  panel.range_m = 40.0;
  panel.set_axis(0.4 * k, 0.5);
  return panel;
}

double off_rad(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

TEST(ToneError, IsStatedWhereGreyValuesAreAPowerOfTheLight) {
  int beyond_sides_own = 0;
  for (const double power : {0.45, 0.6, 1.6}) {
    for (int k = 0; k < 4; ++k) {
      const testing::PaintedPanel scene = slanted_panel(k);
      host::GreyImage image = scene.image();
      sim::apply_tone_curve(image, power);
      const auto panel = measure_panel(image.view(), scene.camera);
      ASSERT_TRUE(panel.ok()) << power << " " << k;
      const PointingResult answer = answer_of(*panel, scene.sight, Tone::kUnknown);
      const double error = off_rad(answer.axis.axis, scene.axis_station);
      EXPECT_LT(error, 5.0 * answer.axis.sigma_rad()) << power << " " << k;
      const auto sides = estimate_axis({panel->long_planes.data(), panel->long_planes.size()});
      ASSERT_TRUE(sides.ok());
      beyond_sides_own += error > 5.0 * sides->sigma_rad() ? 1 : 0;
    }
  }
  EXPECT_GE(beyond_sides_own, 6);
}

// The edges of a rectangle that is tilted and rolled, known to 0.01 px, `moved_px` outwards; a tone curve's sigma is 1
// px.
PanelMeasurement tilted_rectangle(double moved_px) {
  constexpr double kFocal_px = 1000.0, kSigma_rad = 1e-5;
  const Matrix3 R = rotation_exp(Vector3(0.5, 0.7, 0.3));
  std::array<Vector3, 4> corners;
  Vector3 middle = Vector3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = k == 0 || k == 3 ? -2.0 : 2.0, y = k < 2 ? -1.0 : 1.0;
    const Vector3 place = R * Vector3(x, y, 0.0) + Vector3(0.0, 0.0, 12.0);
    corners[k] = place / place.z();
    middle += 0.25 * corners[k];
  }
  const auto plane = [&](std::size_t k, double out_px) {
    const Vector3 &from = corners[k], &to = corners[(k + 1) % 4];
    Vector3 out = (to - from).cross(Vector3(Vector3::UnitZ())).normalized();
    if (out.dot(from - middle) < 0.0) out = -out;
    const Vector3 shift = out_px / kFocal_px * out;
    const Vector3 normal = (from + shift).cross(to + shift).normalized();
    return AxisPlane{normal, kSigma_rad * kSigma_rad * (Matrix3::Identity() - normal * normal.transpose())};
  };
  PanelMeasurement panel;
  for (const std::size_t k : {0U, 2U}) {
    panel.long_planes.push_back(plane(k, moved_px));
    panel.long_planes_moved.push_back(plane(k, moved_px + 1.0));
    panel.short_planes.push_back(plane(k + 1, moved_px));
    panel.short_planes_moved.push_back(plane(k + 1, moved_px + 1.0));
  }
  return panel;
}

TEST(ToneError, IsWhatTheRightAngleLeaves) {
  EXPECT_LT(tone_error(tilted_rectangle(0.0)).sigma, 0.1);
  EXPECT_NEAR(tone_error(tilted_rectangle(2.0)).sigma, 2.0, 0.1);
  PanelMeasurement without_ends = tilted_rectangle(0.0);
  without_ends.short_planes = without_ends.short_planes_moved = {};
  EXPECT_EQ(tone_error(without_ends).sigma, 1.0);
  EXPECT_GT(tone_error(without_ends).shift.norm(), 1e-4);
}

}  // namespace
}  // namespace pharos::pointing
