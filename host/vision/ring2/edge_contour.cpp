// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/edge_contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/ellipse/direct_fit.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/ring2/circle_model.hpp"

namespace pharos::host {
namespace {

using ring2::Contour;
using ring2::Matrix5;
using ring2::Vector5;

// Number of points of the circle that are projected to compute the expected ellipse.
constexpr int kCirclePoints = 48;
// Distance between profiles; nearer ones would share pixels.
constexpr double kSpacing_px = 1.5;
constexpr int kMinProfiles = 48, kMaxProfiles = 720;
// Sampling step along a profile, and the derivative-of-Gaussian kernel in units of that step. The kernel adds about its
// own width to the blur of optics and pixel, and reduces noise in return.
constexpr double kStep_px = 0.5;
constexpr int kHalfKernel = 5;
constexpr double kKernelSigma_px = 0.8;
// Minimum slope of an edge: one count of eight bits per pixel, which is above dark noise and rounding.
constexpr double kMinSlope = 257.0;
// Fraction of the profiles at which a true contour has its edge; shadow, gloss and occlusion hide it at the others.
constexpr double kFoundFraction = 0.7;
// Minimum scatter of edge points about the ellipse: pixels and interpolation.
constexpr double kMinScatter_px = 0.05;
// Maximum lag, in profiles, at which the correlation of residuals is computed.
constexpr int kMaxLag = 40;
// Regularisation towards the expected parameters, relative to their information: keeps the matrix regular without
// edges.
constexpr double kRidge = 1e-6;

struct Profile {
  Vector2 place = Vector2::Zero();
  Vector5 slope = Vector5::Zero();  // of the contour's displacement with its parameters
  EdgePeaks peaks;
  double offset_px = 0.0;  // of the chosen edge
  double weight = 0.0;
};

std::array<double, 2 * kHalfKernel + 1> make_kernel() {
  std::array<double, 2 * kHalfKernel + 1> kernel{};
  double gain = 0.0;
  for (int i = -kHalfKernel; i <= kHalfKernel; ++i) {
    const double x = i * kStep_px / kKernelSigma_px;
    kernel[static_cast<std::size_t>(i + kHalfKernel)] = x * std::exp(-0.5 * x * x);
    gain += kernel[static_cast<std::size_t>(i + kHalfKernel)] * i * kStep_px;
  }
  for (double& value : kernel) value /= gain;  // a slope of 1 per pixel gives 1
  return kernel;
}

std::optional<double> grey_at(ImageView<const std::uint16_t> image, double u, double v) {
  const double fu = std::floor(u), fv = std::floor(v);
  if (!(fu >= 0.0 && fv >= 0.0 && fu < image.width_px - 1 && fv < image.height_px - 1)) return std::nullopt;
  const auto x = static_cast<std::int32_t>(fu), y = static_cast<std::int32_t>(fv);
  const double a = u - fu, b = v - fv;
  const std::uint16_t* upper = image.row(y) + x;
  const std::uint16_t* lower = image.row(y + 1) + x;
  return (1.0 - b) * ((1.0 - a) * upper[0] + a * upper[1]) + b * ((1.0 - a) * lower[0] + a * lower[1]);
}

// Empty if the profile leaves the image.
std::optional<EdgePeaks> peaks_across(ImageView<const std::uint16_t> image, const Vector2& place, const Vector2& normal,
                                      double reach_px) {
  static const auto kernel = make_kernel();
  constexpr int kMaxHalf = 60;
  const int half = std::min(kMaxHalf - kHalfKernel - 1, static_cast<int>(reach_px / kStep_px) + 1);
  const int ends = half + kHalfKernel;
  std::array<double, 2 * kMaxHalf + 1> grey{};
  for (int i = -ends; i <= ends; ++i) {
    const auto value = grey_at(image, place.x() + i * kStep_px * normal.x(), place.y() + i * kStep_px * normal.y());
    if (!value) return std::nullopt;
    grey[static_cast<std::size_t>(i + ends)] = *value;
  }
  std::array<double, 2 * kMaxHalf + 1> steep{};
  for (int i = 0; i <= 2 * half; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * grey[static_cast<std::size_t>(i) + k];
    steep[static_cast<std::size_t>(i)] = std::abs(sum);
  }
  EdgePeaks peaks;
  for (int i = 1; i < 2 * half && peaks.count < peaks.slope.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (steep[at] < kMinSlope || steep[at] < steep[at - 1] || steep[at] <= steep[at + 1]) continue;
    const double bend = steep[at - 1] - 2.0 * steep[at] + steep[at + 1];
    const double between = bend < 0.0 ? 0.5 * (steep[at - 1] - steep[at + 1]) / bend : 0.0;
    const double offset = (i - half + between) * kStep_px;
    if (std::abs(offset) > reach_px) continue;
    peaks.offset_px[peaks.count] = offset;
    peaks.slope[peaks.count++] = steep[at];
  }
  return peaks;
}

std::optional<ellipse::Ellipse> expected_ellipse(const ring2::RigView& view, const ExpectedCircle& circle) {
  const std::array<Vector3, 2> axes = ring2::tilt_axes(circle.normal);
  std::vector<ellipse::PointF> points;
  for (int k = 0; k < kCirclePoints; ++k) {
    const double angle = kTwoPi * k / kCirclePoints;
    const Vector3 place = circle.centre_m + circle.radius_m * (std::cos(angle) * axes[0] + std::sin(angle) * axes[1]);
    const auto pixel = project(view.intrinsics, view.T_rig_camera.R.transpose() * (place - view.T_rig_camera.t));
    if (!pixel) return std::nullopt;
    points.push_back({static_cast<float>(pixel->x()), static_cast<float>(pixel->y())});
  }
  return ellipse::fit_direct(points);
}

double weight_of(double offset_px, double scale_px) {
  const double ratio = offset_px / scale_px;
  const double inverse = 1.0 / (1.0 + ratio * ratio);
  return inverse * inverse;
}

// Chooses the profile's edge with the largest product of slope and distance weight.
void take_edge(Profile& profile, double scale_px) {
  double best = 0.0;
  for (std::size_t i = 0; i < profile.peaks.count; ++i) {
    const double weight = weight_of(profile.peaks.offset_px[i], scale_px);
    if (profile.peaks.slope[i] * weight <= best) continue;
    best = profile.peaks.slope[i] * weight;
    profile.offset_px = profile.peaks.offset_px[i];
    profile.weight = weight;
  }
}

// Profiles at equal distances along the contour, without those that leave the image.
std::vector<Profile> profiles_along(ImageView<const std::uint16_t> image, const Contour& contour,
                                    const EdgeSearch& search) {
  const double perimeter = ellipse::perimeter_px(contour.ellipse);
  const int count = std::clamp(static_cast<int>(perimeter / kSpacing_px), kMinProfiles, kMaxProfiles);
  std::vector<Profile> profiles;
  double anomaly = 0.0;
  for (int k = 0; k < count; ++k) {
    const ellipse::PointPx point = ellipse::point_at(contour.ellipse, anomaly);
    const double speed = std::hypot(contour.ellipse.a_px * std::sin(anomaly), contour.ellipse.b_px * std::cos(anomaly));
    anomaly += perimeter / count / speed;
    const Contour::Offset offset = contour.offset_of({point.u, point.v});
    const auto peaks = peaks_across(image, {point.u, point.v}, offset.normal, search.reach_px);
    if (!peaks) continue;
    Profile profile{{point.u, point.v}, offset.slope, *peaks, 0.0, 0.0};
    take_edge(profile, search.scale_px);
    profiles.push_back(profile);
  }
  return profiles;
}

Contour contour_with(const Vector2& centre, const Matrix2& shape) {
  Contour contour;
  const double mean = 0.5 * (shape(0, 0) + shape(1, 1)), half = 0.5 * (shape(0, 0) - shape(1, 1));
  const double turn = std::hypot(half, shape(0, 1));
  contour.ellipse = {centre.x(), centre.y(), std::sqrt(mean + turn), std::sqrt(std::max(0.0, mean - turn)),
                     0.5 * std::atan2(shape(0, 1), half)};
  contour.centre_px = centre;
  contour.shape_px2 = shape;
  contour.inverse_shape = shape.inverse();
  return contour;
}

// Residuals of one contour about its own ellipse: their standard deviation, and by their autocorrelation the number of
// neighbouring profiles that share one error.
struct Scatter {
  double sigma_px = 0.0;
  double alike = 1.0;
};

Scatter scatter_of(const std::vector<Profile>& profiles, const Vector5& moved) {
  std::vector<double> rest(profiles.size(), 0.0);
  double squares = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const double root = std::sqrt(profiles[i].weight);
    rest[i] = root * (profiles[i].offset_px - profiles[i].slope.dot(moved));
    squares += rest[i] * rest[i];
    weights += profiles[i].weight;
  }
  Scatter scatter{std::sqrt(squares / std::max(1.0, weights - 5.0)), 1.0};
  for (int lag = 1; lag <= kMaxLag && lag < static_cast<int>(rest.size()); ++lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rest.size(); ++i)
      sum += rest[i] * rest[(i + static_cast<std::size_t>(lag)) % rest.size()];
    const double correlation = squares > 0.0 ? sum / squares : 0.0;
    if (correlation < 0.05) break;
    scatter.alike += 2.0 * correlation;
  }
  scatter.sigma_px = std::max(scatter.sigma_px, kMinScatter_px);
  return scatter;
}

// Saturation, lips narrower than the blur, and sides that differ by more than one step shift an edge by a part of its
// blur, equally along the whole contour. This makes sizes less accurate than positions and shapes.
constexpr double kGrowthSigma_px = 0.3;
// Scatter of an undisturbed edge about the circle.
constexpr double kCleanScatter_px = 0.25;
constexpr double kMinClean = 0.1;
// Error of a whole contour by the fraction of the expected evidence that it has. Of 312 contours of 78 random bodies
// (`pharos reproduce integrity --kind ring2 --seed 440001`) centre and shape are off the true ellipse by 0.03 px in the
// median where nothing disturbs them, by 0.2 px at a fraction of 0.6, 0.3 px at 0.4. Some are of another edge than all
// others are, a nozzle's wall for its lip, so that 0.07 px are stated of the best and 0.25 px (1/f - 1) more at a
// fraction f: with 0.05 and 0.18, one position of 78 fresh bodies was 4.3 sigmas off, and that of seed 10330 more than
// 5; now 3.2 and 4.1.
constexpr double kStatedClean_px = 0.07, kStatedPerDisturbance_px = 0.25;
constexpr double kMinStatedClean = 0.25;
double stated_px(double clean) {
  return kStatedClean_px + kStatedPerDisturbance_px * (1.0 / std::clamp(clean, kMinStatedClean, 1.0) - 1.0);
}
// Neighbouring profiles that share pixels of image and kernel.
constexpr double kAlike = 3.5 / kSpacing_px;

// The information that remains if the whole contour may be shifted outwards by a common error of kGrowthSigma_px.
Matrix5 without_growth(const Matrix5& information, const ellipse::Ellipse& e) {
  const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad), a = 2.0 * e.a_px, b = 2.0 * e.b_px;
  const Vector5 growth(0.0, 0.0, a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c);
  const Vector5 pulled = information * growth;
  const double variance = kGrowthSigma_px * kGrowthSigma_px;
  return information - (variance / (1.0 + variance * growth.dot(pulled))) * pulled * pulled.transpose();
}

// Log-likelihood ratio of the profiles' edges, circle against chance; by chance, edges are uniform within the search
// range.
struct Evidence {
  double sum = 0.0;
  double limit = 0.0;
};
Evidence evidence_of(const std::vector<Profile>& profiles, double sigma_px, double reach_px) {
  double edges = 0.0;
  for (const Profile& profile : profiles) edges += static_cast<double>(profile.peaks.count);
  const double density = std::max(edges, 1.0) / (2.0 * reach_px * static_cast<double>(profiles.size()));
  double sum = 0.0;
  for (const Profile& profile : profiles) {
    double near = 0.0;
    for (std::size_t i = 0; i < profile.peaks.count; ++i) {
      const double z = profile.peaks.offset_px[i] / sigma_px;
      near += std::exp(-0.5 * z * z) / (sigma_px * std::sqrt(kTwoPi));
    }
    sum += std::log(1.0 - kFoundFraction + kFoundFraction * near / density);
  }
  const double clean = 1.0 / (kCleanScatter_px * std::sqrt(kTwoPi));
  const double limit = std::log(1.0 - kFoundFraction + kFoundFraction * clean / density);
  return {sum / kAlike, std::max(1e-9, limit * static_cast<double>(profiles.size()) / kAlike)};
}

}  // namespace

std::vector<ContourPeaks> contour_peaks(const ring2::RigView& view, ImageView<const std::uint16_t> image,
                                        const ExpectedCircle& circle, double reach_px, double max_width) {
  ExpectedCircle wide = circle, narrow = circle;
  wide.radius_m *= 1.0 + max_width;
  narrow.radius_m *= 1.0 - max_width;
  const auto expected = expected_ellipse(view, circle);
  const auto outer = expected_ellipse(view, wide), inner = expected_ellipse(view, narrow);
  if (!expected || !outer || !inner || !ring2::is_usable(*expected)) return {};
  const Contour contour = ring2::contour_of(*expected, 1.0, 1.0);
  const Contour outside = ring2::contour_of(*outer, 1.0, 1.0), inside = ring2::contour_of(*inner, 1.0, 1.0);
  std::vector<ContourPeaks> peaks;
  for (const Profile& profile : profiles_along(image, contour, {reach_px, 1.0})) {
    // Perspective shifts the centre of a wider circle's image: the distance differs around the contour.
    const double to_outer = -outside.offset_of(profile.place).distance_px;
    const double to_inner = -inside.offset_of(profile.place).distance_px;
    peaks.push_back({profile.peaks, 0.5 * (to_outer - to_inner) / max_width,
                     0.5 * (to_outer + to_inner) / (max_width * max_width)});
  }
  return peaks;
}

std::optional<EdgeContour> edge_contour(const ring2::RigView& view, ImageView<const std::uint16_t> image,
                                        const ExpectedCircle& circle, const EdgeSearch& search, double systematic_px) {
  const auto expected = expected_ellipse(view, circle);
  if (!expected || !ring2::is_usable(*expected)) return std::nullopt;
  const Contour before = ring2::contour_of(*expected, 1.0, 1.0);
  const std::vector<Profile> profiles = profiles_along(image, before, search);
  if (profiles.size() < kMinProfiles / 2) return std::nullopt;
  Matrix5 information = Matrix5::Zero();
  Vector5 pull = Vector5::Zero();
  double weights = 0.0, seen = 0.0;
  for (const Profile& profile : profiles) {
    add_outer<5>(information, profile.slope, profile.weight);
    pull += profile.weight * profile.offset_px * profile.slope;
    weights += profile.weight;
    seen += profile.weight > 0.25 ? 1.0 : 0.0;  // within one scale_px
  }
  Matrix5 regular = information;
  for (int i = 0; i < 5; ++i) regular(i, i) += kRidge * (before.information(i, i) + information(i, i));
  const auto inverse = positive_inverse<5>(regular);
  if (!inverse) return std::nullopt;
  const Vector5 moved = *inverse * pull;
  Matrix2 shape = before.shape_px2;
  shape(0, 0) += moved[2];
  shape(0, 1) += moved[3];
  shape(1, 0) += moved[3];
  shape(1, 1) += moved[4];
  EdgeContour result;
  result.contour = contour_with(before.centre_px + moved.head<2>(), shape);
  if (!ring2::is_usable(result.contour.ellipse)) return std::nullopt;
  const Scatter scatter = scatter_of(profiles, moved);
  const double variance = scatter.sigma_px * scatter.sigma_px * scatter.alike;
  result.edges = static_cast<int>(seen);
  const Evidence evidence = evidence_of(profiles, scatter_of(profiles, Vector5::Zero()).sigma_px, search.reach_px);
  // The systematic error is common to all edge points, so that their number does not reduce it. It is larger for
  // disturbed contours, because a disturbance also shifts the edges that remain.
  const double clean = evidence.sum / evidence.limit;
  const double disturbed_px = systematic_px / std::sqrt(std::clamp(clean, kMinClean, 1.0));
  const double floor = disturbed_px * disturbed_px * weights;
  result.contour.information = without_growth(information / (variance + floor), result.contour.ellipse);
  const double stated_floor = stated_px(clean) * stated_px(clean) * weights;
  result.stated_information = without_growth(information / (variance + stated_floor), result.contour.ellipse);
  result.contour.sigma_px = scatter.sigma_px;
  result.seen = seen / static_cast<double>(profiles.size());
  result.evidence = evidence.sum;
  result.evidence_limit = evidence.limit;
  return result;
}

}  // namespace pharos::host
