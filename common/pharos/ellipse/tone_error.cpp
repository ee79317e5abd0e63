// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/tone_error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "pharos/ellipse/blurred_contour.hpp"
#include "pharos/ellipse/contour_places.hpp"

namespace pharos::ellipse {
namespace {

constexpr int kNormals = 48;
// Along the normal, 1 px apart: the levels on both sides are the brightest and the darkest value so far away.
constexpr int kBeside_px = 4;
constexpr std::size_t kProfile = 2 * kBeside_px + 1;
// Of the mean step: where the contour is hidden there is none of it.
constexpr double kMinRise = 0.25;
// Variance of what linear interpolation between pixels adds to an edge.
constexpr double kInterpolation_px2 = 1.0 / 6.0;
// Of an edge in the light, 1 sigma: a pixel alone, and what the reach shows.
constexpr double kMinBlur_px = 0.3, kMaxBlur_px = 3.0;

struct ToneStep {
  PointF point;
  double rise = 0.0;  // over the 2 px across the contour, from its darker to its brighter side
  double dark = 0.0, bright = 0.0;

  double height() const { return bright - dark; }
  double contrast() const { return std::clamp(height() / (bright + dark), 0.0, 1.0); }
};

class ToneSteps {
 public:
  ToneSteps(ImageView<const std::uint16_t> image, const DetectedEllipse& found)
      : image_(image), e_(found.ellipse), bright_inside_(found.bright_inside) {
    ContourPlaces places(e_, kNormals);
    for (int k = 0; k < kNormals; ++k) {
      const std::optional<ToneStep> step = step_at(places.next());
      if (step) steps_[count_++] = *step;
    }
    leave_hidden();
  }

  std::span<const ToneStep> all() const { return {steps_.data(), count_}; }

  // Of the edge in the light, 1 sigma: how much of its step lies within 1 px on either side.
  double blur_px() const {
    double rise = 0.0, height = 0.0;
    for (const ToneStep& step : all()) rise += step.rise, height += step.height();
    double low = kMinBlur_px, high = kMaxBlur_px;
    constexpr int kHalvings = 16;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      const double within = std::erf(1.0 / std::sqrt(2.0 * (middle * middle + kInterpolation_px2)));
      (within * height > rise ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  // Nothing near the border, nor where the contour does not rise to its brighter side.
  std::optional<ToneStep> step_at(const ContourPlaces::Place& place) const {
    const int inside = std::min(kBeside_px, std::max(1, static_cast<int>(e_.b_px)));
    const PointPx p = place.point;
    if (p.u < kBeside_px || p.v < kBeside_px || p.u > image_.width_px - 1.001 - kBeside_px ||
        p.v > image_.height_px - 1.001 - kBeside_px) {
      return std::nullopt;
    }
    std::array<double, kProfile> values{};
    for (int k = -inside; k <= kBeside_px; ++k) {
      values[static_cast<std::size_t>(k + kBeside_px)] = grey(p.u + k * place.normal_u, p.v + k * place.normal_v);
    }
    const auto middle = values.begin() + kBeside_px;
    const std::span<const double> within(middle - inside, middle), beyond(middle + 1, values.end());
    const std::span<const double> brighter = bright_inside_ ? within : beyond,
                                  darker = bright_inside_ ? beyond : within;
    ToneStep step{{static_cast<float>(p.u), static_cast<float>(p.v)}};
    step.rise = (bright_inside_ ? 1.0 : -1.0) * (*(middle - 1) - *(middle + 1));
    step.bright = *std::max_element(brighter.begin(), brighter.end());
    step.dark = *std::min_element(darker.begin(), darker.end());
    if (!(step.rise > 0.0)) return std::nullopt;
    return step;
  }
  double grey(double u, double v) const {
    const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
    const double p = u - column, q = v - row;
    const std::uint16_t *above = image_.row(row) + column, *below = image_.row(row + 1) + column;
    return (1.0 - q) * ((1.0 - p) * above[0] + p * above[1]) + q * ((1.0 - p) * below[0] + p * below[1]);
  }
  void leave_hidden() {
    double sum = 0.0;
    for (std::size_t k = 0; k < count_; ++k) sum += steps_[k].rise;
    const double limit = kMinRise * sum / std::max<double>(1.0, static_cast<double>(count_));
    const auto end = std::remove_if(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(count_),
                                    [limit](const ToneStep& step) { return step.rise < limit; });
    count_ = static_cast<std::size_t>(end - steps_.begin());
  }

  ImageView<const std::uint16_t> image_;
  const Ellipse& e_;
  bool bright_inside_;
  std::array<ToneStep, kNormals> steps_{};
  std::size_t count_ = 0;
};

void widen(ImageView<const std::uint16_t> image, DetectedEllipse& found) {
  const ToneSteps steps(image, found);
  if (steps.all().size() <= 5) return;
  const double outwards_px = (found.bright_inside ? 1.0 : -1.0) * steps.blur_px();
  std::array<PointF, kNormals> points;
  std::transform(steps.all().begin(), steps.all().end(), points.begin(),
                 [](const ToneStep& step) { return step.point; });
  const BlurredContour contour(found.ellipse);
  ContourDistances distances;
  contour.measure(std::span<const PointF>(points.data(), steps.all().size()), distances);
  Matrix5 matrix = Matrix5::Zero();
  Vector5 moved = Vector5::Zero();
  for (std::size_t k = 0; k < steps.all().size(); ++k) {
    const Vector5 slope = contour.slope(distances, k);
    matrix += slope * slope.transpose();
    moved += outwards_px * tone_shift(steps.all()[k].contrast()) * slope;
  }
  const Eigen::LDLT<Matrix5> solver(matrix);
  if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 1e-12 * matrix.trace()) return;
  const Vector5 change = contour.axes_slope() * solver.solve(moved);
  found.covariance += change * change.transpose();
  limit_direction(found.covariance);
}

}  // namespace

double tone_shift(double contrast) {
  // The normal distribution's quantile of 1/2 + contrast / 4, within 0.1 %: its series to the third order, the last
  // term such that contrast 1 is right.
  constexpr double kQuartile = 0.67448975019608171;
  const double linear = std::sqrt(2.0 * std::numbers::pi) / 4.0;
  return contrast * (linear + (kQuartile - linear) * contrast * contrast);
}

void add_tone_error(ImageView<const std::uint16_t> image, EllipseWorkspace& workspace) {
  for (DetectedEllipse& found : workspace.found) widen(image, found);
}

}  // namespace pharos::ellipse
