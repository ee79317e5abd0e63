// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/rim_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

// Docking rings have faces of 4 to 13 % of their radius.
constexpr double kMaxFace = 0.2;
// Edges nearer than this merge in the image, by filter and blur.
constexpr double kMinFace_px = 2.2;
constexpr double kMaxFaceReach_px = 26.0;
// Scatter of the second edge about its circle: blur, and the error of the first circle.
constexpr double kFaceScatter_px = 0.5;
constexpr double kFaceFound = 0.6;
// Neighbouring profiles that share pixels, see edge_contour.
constexpr double kSharing = 2.3;
constexpr int kWidthSteps = 160;

// Log-likelihood ratio of one view's profiles for a circle wider by `width` of the radius.
double face_evidence_at(const std::vector<ContourPeaks>& profiles, double density, double width) {
  double sum = 0.0;
  for (const ContourPeaks& profile : profiles) {
    const double place_px = width * (profile.slope_px + width * profile.bend_px);
    double near = 0.0;
    for (std::size_t i = 0; i < profile.peaks.count; ++i) {
      const double z = (profile.peaks.offset_px[i] - place_px) / kFaceScatter_px;
      if (std::abs(z) < 4.0) near += std::exp(-0.5 * z * z) / (kFaceScatter_px * std::sqrt(kTwoPi));
    }
    sum += std::log(1.0 - kFaceFound + kFaceFound * near / density);
  }
  return sum / kSharing;
}

}  // namespace

double rim_evidence(const ring2::Rig& rig, const Ring2Images& images, const ExpectedCircle& circle) {
  std::array<std::vector<ContourPeaks>, ring2::kViews> profiles;
  std::array<double, ring2::kViews> density{};
  double largest_px = 0.0;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    const Vector3 from = circle.centre_m - rig.views[v].T_rig_camera.t;
    const double radius_px = rig.views[v].intrinsics.fx_px * circle.radius_m / from.norm();
    const double reach_px = std::min(kMaxFaceReach_px, kMaxFace * radius_px + 2.0);
    profiles[v] = contour_peaks(rig.views[v], images[v], circle, reach_px, kMaxFace);
    if (profiles[v].empty()) continue;
    largest_px = std::max(largest_px, radius_px);
    double peaks = 1.0;
    for (const ContourPeaks& profile : profiles[v]) peaks += static_cast<double>(profile.peaks.count);
    density[v] = peaks / (2.0 * reach_px * static_cast<double>(profiles[v].size()));
  }
  if (!(largest_px > 0.0)) return 0.0;
  const double min_width = kMinFace_px / largest_px, max_width = std::min(kMaxFace, kMaxFaceReach_px / largest_px);
  double best = 0.0;
  for (int k = -kWidthSteps; k <= kWidthSteps; ++k) {
    const double width = max_width * k / kWidthSteps;
    if (std::abs(width) < min_width) continue;
    double sum = 0.0;
    for (std::size_t v = 0; v < ring2::kViews; ++v) {
      // An edge that is missing in one image is no evidence against it: it may be hidden or without contrast there.
      if (!profiles[v].empty()) sum += std::max(0.0, face_evidence_at(profiles[v], density[v], width));
    }
    best = std::max(best, sum);
  }
  return best;
}

}  // namespace pharos::host
