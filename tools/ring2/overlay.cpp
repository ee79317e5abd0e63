// SPDX-License-Identifier: Apache-2.0
#include "tools/ring2/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/images/canvas.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

namespace colours = host::colours;

// Both images in one, the right one beside the left.
host::GreyImage side_by_side(const std::array<host::GreyImage, 2>& images) {
  host::GreyImage joined;
  joined.width_px = images[0].width_px + images[1].width_px;
  joined.height_px = std::max(images[0].height_px, images[1].height_px);
  joined.pixels.resize(static_cast<std::size_t>(joined.width_px) * static_cast<std::size_t>(joined.height_px));
  std::int32_t begin = 0;
  for (const host::GreyImage& image : images) {
    for (std::int32_t v = 0; v < image.height_px; ++v) {
      std::copy_n(image.view().row(v), image.width_px, joined.view().row(v) + begin);
    }
    begin += image.width_px;
  }
  return joined;
}

// Draws into one half of the picture.
class Half {
 public:
  Half(host::Canvas& canvas, const ring2::RigView& view, double shift_px)
      : canvas_(canvas), view_(view), shift_px_(shift_px) {}

  void ellipse(const ellipse::Ellipse& e, host::Colour colour, double width, bool dashed) {
    canvas_.ellipse({e.cx_px + shift_px_, e.cy_px}, e.a_px, e.b_px, e.theta_rad, colour, width, dashed);
  }
  std::optional<host::Place> place_of(const Vector3& point_m) const {
    const Pose<frame::Camera, frame::Rig> T_camera_rig = view_.T_rig_camera.inverse();
    const auto pixel = project(view_.intrinsics, T_camera_rig * point_m);
    if (!pixel) return std::nullopt;
    return host::Place{pixel->x() + shift_px_, pixel->y()};
  }
  void circle(const Vector3& centre_m, const Vector3& normal, double radius_m, host::Colour colour) {
    constexpr int kPieces = 180;
    const auto axes = ring2::tilt_axes(normal);
    std::vector<host::Place> places;
    for (int k = 0; k <= kPieces; ++k) {
      const double angle = kTwoPi * k / kPieces;
      const Vector3 out = std::cos(angle) * axes[0] + std::sin(angle) * axes[1];
      if (const auto place = place_of(centre_m + radius_m * out)) places.push_back(*place);
    }
    canvas_.polyline(places, colour, 1.5);
  }
  void arrow(const Vector3& from_m, const Vector3& to_m, host::Colour colour) {
    const auto from = place_of(from_m);
    const auto to = place_of(to_m);
    if (from && to) canvas_.arrow(*from, *to, colour, 3.0);
  }

 private:
  host::Canvas& canvas_;
  const ring2::RigView& view_;
  double shift_px_;
};

void draw_estimate(Half& half, const ring2::Ring2Estimate& e) {
  if ((e.unobservable & ring2::kUnobservableScale) != 0) return;
  const bool ring = (e.unobservable & ring2::kUnobservableRing) == 0;
  const bool nozzle = (e.unobservable & ring2::kUnobservableNozzle) == 0;
  if (ring) half.circle(e.ring_centre_m, e.normal, e.ring_radius_m, colours::kGreen);
  if (nozzle) half.circle(e.nozzle_centre_m, e.normal, e.nozzle_radius_m, colours::kYellow);
  const Vector3& foot = ring ? e.ring_centre_m : e.nozzle_centre_m;
  half.arrow(foot, foot + e.normal * (ring ? e.ring_radius_m : 3.0 * e.nozzle_radius_m), colours::kOrange);
}

std::string words_of(const host::Ring2Detection& circles) {
  if (!circles.estimate) return "refused_" + circles.refusal;
  const ring2::Attitude attitude = ring2::attitude_of(circles.estimate->normal);
  return fmt::format("theta {:.3f} gamma {:.3f} deg, sigma {:.3f} deg{}", attitude.theta_rad * kDegPerRad,
                     attitude.gamma_rad * kDegPerRad, circles.estimate->sigma_normal_rad() * kDegPerRad,
                     circles.estimate->ambiguous() ? ", ambiguous" : "");
}

}  // namespace

void write_ring2_overlay(const std::string& path, const std::array<host::GreyImage, 2>& images, const ring2::Rig& rig,
                         const host::Ring2Detection& circles) {
  const host::GreyImage joined = side_by_side(images);
  host::Canvas canvas(joined.view(), host::Canvas::zoom_for(joined.width_px));
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    Half half(canvas, rig.views[v], v == 0 ? 0.0 : images[0].width_px);
    for (const ellipse::DetectedEllipse& found : circles.found[v])
      half.ellipse(found.ellipse, colours::kGrey, 1.0, true);
    for (const auto& contour : circles.contours[v]) {
      if (contour) half.ellipse(contour->ellipse, colours::kSky, 3.0, false);
    }
    if (circles.estimate) draw_estimate(half, *circles.estimate);
  }
  canvas.text({4.0, 4.0}, words_of(circles), circles.estimate ? colours::kWhite : colours::kOrange);
  canvas.write_png(path);
}

}  // namespace pharos::tools
