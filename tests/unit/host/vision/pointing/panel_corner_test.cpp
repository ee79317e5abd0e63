// SPDX-License-Identifier: Apache-2.0
// Panels and bodies of which one end is hidden, told apart by the outline's corners at the other sides' ends.
#include <gtest/gtest.h>

#include "host/vision/pointing/measure_panel.hpp"
#include "pharos/base/units.hpp"
#include "support/painted_panel.hpp"

namespace pharos::pointing {
namespace {

using testing::PaintedPanel;

double error_deg(const PointingResult& answer, const PaintedPanel& panel) {
  const Vector3& axis = answer.axis.axis;
  return std::atan2(axis.cross(panel.axis_station).norm(), std::abs(axis.dot(panel.axis_station))) * kDegPerRad;
}

// Fraction of a pixel beyond a place, blurred.
double beyond(double off_px) { return 0.5 * std::erfc(-off_px / (1.2 * std::sqrt(2.0))); }

template <class Change>
void for_pixels(host::GreyImage& image, Change&& change) {
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      auto& pixel = image.pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width_px) +
                                 static_cast<std::size_t>(u)];
      pixel = static_cast<std::uint16_t>(change(Vector2(u, v), static_cast<double>(pixel)));
    }
  }
}

void add_disc(const Vector2& centre, double radius_px, host::GreyImage& image) {
  for_pixels(image, [&](const Vector2& at, double pixel) {
    return std::max(pixel, 600.0 + 30000.0 * beyond(radius_px - (at - centre).norm()));
  });
}

// Sky where `off(place)` is positive.
template <class Off>
void cut(host::GreyImage& image, Off&& off) {
  for_pixels(image, [&](const Vector2& at, double pixel) {
    return 600.0 + (1.0 - beyond(off(at))) * std::max(0.0, pixel - 600.0);
  });
}

Vector2 pixel_of(const PaintedPanel& panel, const Vector3& place_m) {
  const PinholeCamera& c = panel.camera;
  return {c.fx_px * place_m.x() / place_m.z() + c.cx_px, c.fy_px * place_m.y() / place_m.z() + c.cy_px};
}

// The middle of the end that is farther away, or nearer.
Vector2 end_of(const PaintedPanel& panel, bool farther) {
  const Vector3 axis = pointing::camera_to_station(panel.sight).transpose() * panel.axis_station;
  const Vector3 middle(panel.shift_m.x(), panel.shift_m.y(), panel.range_m);
  return pixel_of(panel, middle + ((axis.z() > 0.0) == farther ? 0.5 : -0.5) * panel.length_m * axis);
}

PaintedPanel steep_panel(double out_rad, double width_m) {
  PaintedPanel panel;
  panel.camera.fx_px = panel.camera.fy_px = 600.0;
  panel.range_m = 16.0;
  panel.length_m = 8.0;
  panel.width_m = width_m;
  panel.set_axis(0.0, out_rad);
  return panel;
}

// Seen along its axis a panel is longer in the image across it than along it. A disc hides the middle of one end: what
// is left of it, with the other end whole, looks like a panel of which one end is hidden. The outline goes on to a
// corner there, and the edge at that corner is what tells the two apart (74 deg off, seed 464491 of the campaign).
TEST(PanelCorner, ThePartOfAnEndIsNoPanelsSide) {
  int answered = 0;
  for (const double down_m : {1.5, 2.5}) {
    for (const bool farther : {true, false}) {
      PaintedPanel panel = steep_panel(1.3, 5.0);
      panel.shift_m = {0.0, down_m};
      host::GreyImage image = panel.image();
      const Vector2 middle = end_of(panel, farther);
      add_disc(middle, farther ? 38.0 : 61.0, image);
      const auto found = measure_panel(image.view(), panel.camera);
      if (!found) continue;
      const PointingResult answer = answer_of(*found, panel.sight, Tone::kLinear);
      ++answered;
      EXPECT_LT(error_deg(answer, panel), 0.5) << down_m << (farther ? " farther" : " nearer");
    }
  }
  EXPECT_GE(answered, 3);
}

// A disc before one end; the outline turns there, before the disc, along another face's edge that is not square to the
// sides.
host::GreyImage with_a_slanted_end(const PaintedPanel& panel, double slant_rad) {
  host::GreyImage image = panel.image();
  const auto whole = measure_panel(image.view(), panel.camera);
  EXPECT_TRUE(whole.ok());
  if (!whole) return image;
  const Segment& end = whole->short_edges[0];
  const Segment& one = whole->long_edges[0];
  const bool at_end = (one.end - end.middle()).norm() < (one.begin - end.middle()).norm();
  const Vector2 along = at_end ? one.along() : Vector2(-one.along());
  const Vector2 inwards = (whole->long_edges[1].middle() - one.middle()).normalized();
  const Vector2 corner = (at_end ? one.end : one.begin) - 0.3 * one.length() * along;
  const Vector2 outwards = std::sin(slant_rad) * along - std::cos(slant_rad) * inwards;
  cut(image, [&](const Vector2& at) { return outwards.dot(at - corner); });
  add_disc(end.middle() + 0.1 * end.length() * inwards, 0.62 * end.length(), image);
  return image;
}

PaintedPanel near_panel() {
  PaintedPanel panel;
  panel.camera.fx_px = panel.camera.fy_px = 450.0;
  panel.range_m = 12.0;
  panel.width_m = 3.0;
  panel.length_m = 8.0;
  panel.set_axis(0.4, 0.95);
  return panel;
}

// Seed 464207 of the campaign, 90 deg off.
TEST(PanelCorner, TwoFacesOfAlikeLightAreNoPanel) {
  const PaintedPanel body = near_panel();
  EXPECT_FALSE(measure_panel(with_a_slanted_end(body, 0.6).view(), body.camera).ok());
}

}  // namespace
}  // namespace pharos::pointing
