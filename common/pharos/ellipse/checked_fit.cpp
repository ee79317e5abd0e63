// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/checked_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "pharos/ellipse/blurred_contour.hpp"
#include "pharos/ellipse/sectors.hpp"

namespace pharos::ellipse {
namespace {

// A contour of which less has edges is partly hidden or outside the image.
constexpr double kWhole = 0.8;
// Of the smaller axis: what both must be known to, and by how many sigmas where a part of the contour tells the whole.
constexpr double kAxisTolerance = 0.1;
constexpr double kDeterminedSigmas = 5.0;
// Of the points, so many must be left where those beside gaps are not used.
constexpr double kMinKept = 0.55;
// Smaller contours may be cut without a gap that shows it.
constexpr double kMaxDot_px = 12.0;
// The steepest place of an edge of blur s and gradient g moves by s^2 n'/g; the noise's slope n' is sigma / 1.1 px.
constexpr double kNoiseToEdge_px = 1.7;
// Another object's edge, where it covers the contour, has another step.
constexpr double kMinVariation = 0.3;  // of the squared gradients: with less there is no other step
constexpr float kOtherStep = 1.4F;     // of a point's gradient to the median, or the inverse
// Light changes a contour's step gradually; another object's edge begins with a jump, and less of it tells.
constexpr double kMinVariationAtJump = 0.15;
constexpr float kOtherStepAtJump = 1.2F;
constexpr double kOfOneStep = 0.7;   // of the scatter of all: what the points of one step must scatter less by
constexpr double kMaxByNoise = 9.0;  // squared sigmas by which their fit may differ otherwise

// Of sigma, for a contour of which nearly all is hidden.
constexpr double kPerHidden = 2.0;

using Points = StaticVector<PointF, kMaxFitPoints>;

class FitCheck {
 public:
  FitCheck(const RefinedFit& fit, const Support& support, const EllipseSettings& settings,
           const EllipseWorkspace& workspace)
      : fit_(fit), support_(support), settings_(settings), noise_(static_cast<double>(workspace.noise)) {}

  std::optional<RefinedFit> run() {
    if (support_.count == 0 || !is_plausible(fit_.ellipse, settings_) || is_too_rough()) {
      return std::nullopt;
    }
    const double rms_px = fit_.rms_px;
    if (support_.beside_gaps != 0) leave_gaps();
    if (support_.gradient_variation > kMinVariation) leave_other_steps(rms_px);
    if (support_.gradient_variation > kMinVariationAtJump) add_steps_that_jump();
    if (!is_determined() || is_noise() || rests_on_another_edge()) return std::nullopt;
    add_jackknife(std::span<const PointF>(support_.points.data(), support_.points.size()), fit_);
    widen_dot(rms_px);
    // What hides a part of a contour may bend the rest beyond what its points show.
    const double hidden = std::max(0.0, support_.inside_fraction - support_.length_fraction);
    fit_.covariance *= (1.0 + kPerHidden * hidden) * (1.0 + kPerHidden * hidden);
    limit_direction(fit_.covariance);
    fit_.rms_px = rms_px;
    return fit_;
  }

 private:
  // Corners scatter the points all around. Where half of them agree well, the others are a neighbour's edge or a dark
  // spot beside it, which the fit does not follow.
  bool is_too_rough() const {
    constexpr double kAgree = 0.5, kMoreRough = 1.3;
    const double limit = max_rms_px(fit_.ellipse);
    return fit_.rms_px > limit * (fit_.sigma_px < kAgree * limit ? kMoreRough : 1.0);
  }

  // What edges may scatter about an ellipse: by the image's noise, by what the scene itself is off (print, lens, JPEG),
  // and by a part of its size. A small polygon scatters by more: a square of half-side h by 0.03 h after blur and
  // gates, yet less than a fixed limit for rings allows.
  double max_rms_px(const Ellipse& e) const {
    constexpr double kOfNoise = 1.5, kScene_px = 0.12, kOfSize = 0.015;
    constexpr double kMaxRmsOfPart_px = 0.3, kMinRoughness_px = 0.12, kOfCorners = 0.01;
    const double noise = kOfNoise * kNoiseToEdge_px * noise_;
    const double size = kOfSize * e.b_px;
    // Rougher than a true ring's 0.25 px, with a margin, no part shows the whole; nor does noise of a fiftieth of the
    // size show whether a small contour has corners.
    const double of_shape = support_.length_fraction < kWhole ? kMaxRmsOfPart_px : settings_.max_rms_px;
    const double of_corners = kMinRoughness_px + kOfCorners * e.b_px;
    return std::min({of_shape, of_corners, settings_.max_rms_px,
                     std::sqrt(noise * noise / support_.squared_gradient + kScene_px * kScene_px + size * size)});
  }

  // An axis that is not known to a tenth of the smaller one is no measurement. Where a part of the contour is hidden or
  // outside the image, the rest must say what the whole is: five sigmas, the most that a fit is off, stay within that
  // tenth. Beyond the border the score asks for nothing: there the arcs must turn by as much as a lone one.
  bool is_determined() const {
    const double turn_rad = 2.0 * std::numbers::pi * support_.turn_fraction;
    return knows_axes(fit_, support_.length_fraction < kWhole ? kDeterminedSigmas : 1.0) &&
           (support_.inside_fraction == 1.0 || turn_rad >= static_cast<double>(kMinTurnAlone_rad));
  }

  static bool knows_axes(const RefinedFit& fit, double sigmas) {
    const double limit = kAxisTolerance * fit.ellipse.b_px / sigmas;
    return fit.covariance(2, 2) <= limit * limit && fit.covariance(3, 3) <= limit * limit;
  }

  // Where something hides a contour, its edge bends into the other's within the blur: the points there are left out.
  void leave_gaps() {
    const auto minimum = static_cast<std::size_t>(std::ceil(kMinKept * static_cast<double>(support_.points.size())));
    const auto apart =
        fit_of(minimum, [&](std::size_t k) { return (support_.beside_gaps >> support_.sectors[k] & 1U) == 0; });
    if (apart) take(*apart);
  }

  // What covers a contour may end along it: its edge, of another step, then counts as the contour's. The fit without
  // the points of other steps, and of where they begin, is taken where it is another one or its points agree better;
  // else half of what it would change counts as an error. A rest that does not tell the axes by itself differs by its
  // own noise, and says nothing.
  void leave_other_steps(double rms_px) {
    const auto apart = fit_without(near_other_steps(median_square(), kOtherStep));
    if (!apart) return;
    const Vector5 change = change_to(apart->ellipse);
    const double moved = change.head<4>().squaredNorm();
    const bool is_other =
        apart->rms_px < kOfOneStep * rms_px || moved > kMaxByNoise * apart->covariance.topLeftCorner<4, 4>().trace();
    if (is_other) {
      take(*apart);
    } else if (knows_axes(*apart, kDeterminedSigmas)) {
      add_half_of(change);
    }
  }

  // Where the step jumps by less, which of its sides is the contour's is not known: what the fit would change counts
  // as an error.
  void add_steps_that_jump() {
    const float median = median_square();
    if (!steps_jump(median)) return;
    const auto apart = fit_without(near_other_steps(median, kOtherStepAtJump));
    if (apart && knows_axes(*apart, kDeterminedSigmas)) {
      add_half_of(change_to(apart->ellipse));
    }
  }

  std::optional<RefinedFit> fit_without(std::uint64_t sectors) const {
    return fit_of(0,
                  [&](std::size_t k) { return ((support_.beside_gaps | sectors) >> support_.sectors[k] & 1U) == 0; });
  }

  float median_square() const {
    std::array<float, kMaxFitPoints> squares;
    const std::size_t count = support_.squared_gradients.size();
    std::copy_n(support_.squared_gradients.data(), count, squares.begin());
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(squares.begin(), middle, squares.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  }

  // A bit for each sector with points whose step differs from the median by more than `ratio`, and for their
  // neighbours.
  std::uint64_t near_other_steps(float median_square, float ratio) const {
    const float low = median_square / (ratio * ratio), high = median_square * (ratio * ratio);
    std::uint64_t others = 0;
    for (std::size_t k = 0; k < support_.squared_gradients.size(); ++k) {
      const float squared = support_.squared_gradients[k];
      if (squared < low || squared > high) others |= std::uint64_t{1} << support_.sectors[k];
    }
    return with_neighbours(others, support_.sector_count);
  }

  // Whether the step changes by kOtherStepAtJump from one sector to the next, from the median's to another that holds
  // for kOfOther sectors.
  bool steps_jump(float median_square) const {
    constexpr int kOfOther = 3;
    const SectorSteps steps = sector_steps();
    const float ratio = kOtherStepAtJump * kOtherStepAtJump;
    const auto is_other = [&](float square) {
      return square < median_square / ratio || square > median_square * ratio;
    };
    for (int k = 0; k < support_.sector_count; ++k) {
      for (const int way : {-1, 1}) {
        const float here = steps.at(k), before = steps.at(k - way);
        if (!(here > 0.0F) || !(before > 0.0F) || is_other(before)) continue;
        if (here < ratio * before && before < ratio * here) continue;
        int others = 0;
        while (others < kOfOther && is_other(steps.at(k + way * others)) && steps.at(k + way * others) > 0.0F) ++others;
        if (others == kOfOther) return true;
      }
    }
    return false;
  }

  // Whether pieces between gaps, of another step than the median's, are needed to tell the axes: they may be edges of
  // what covers the contour.
  bool rests_on_another_edge() const {
    const std::uint64_t pieces = other_pieces(median_square());
    if (pieces == 0) return false;
    const auto rest = fit_without(pieces);
    return !rest || !knows_axes(*rest, kDeterminedSigmas);
  }

  // A bit for each sector of the pieces of the contour, of kMinOfPiece sectors or more, that lie between gaps and are
  // of another step all along.
  std::uint64_t other_pieces(float median_square) const {
    constexpr int kMinOfPiece = 3;
    const SectorSteps steps = sector_steps();
    const float ratio = kOtherStepAtJump * kOtherStepAtJump;
    std::uint64_t pieces = 0;
    for (int first = 0; first < steps.count; ++first) {
      if (!(steps.at(first) > 0.0F) || steps.at(first - 1) > 0.0F) continue;
      std::uint64_t piece = 0;
      int length = 0;
      bool is_other = true;
      for (; length < steps.count && steps.at(first + length) > 0.0F; ++length) {
        const float square = steps.at(first + length);
        is_other = is_other && (square < median_square / ratio || square > median_square * ratio);
        piece |= std::uint64_t{1} << ((first + length) % steps.count);
      }
      if (is_other && length >= kMinOfPiece) pieces |= piece;
    }
    return pieces;
  }

  // Mean squared gradients of a contour's sectors, 0 where there are no points.
  struct SectorSteps {
    std::array<float, kMaxSectors> square{};
    int count = 0;
    float at(int sector) const { return square[static_cast<std::size_t>((sector + count) % count)]; }
  };
  SectorSteps sector_steps() const {
    SectorSteps steps;
    steps.count = support_.sector_count;
    std::array<float, kMaxSectors> points{};
    for (std::size_t k = 0; k < support_.sectors.size(); ++k) {
      steps.square[support_.sectors[k]] += support_.squared_gradients[k];
      points[support_.sectors[k]] += 1.0F;
    }
    for (std::size_t k = 0; k < kMaxSectors; ++k) {
      if (points[k] > 0.0F) steps.square[k] /= points[k];
    }
    return steps;
  }

  // Dots of a few pixels that noise makes have gradients of a few of its sigmas.
  bool is_noise() const {
    constexpr double kMinSigmas = 10.0, kMaxNoise_px = 9.0;
    const double limit = kMinSigmas * noise_;
    return fit_.ellipse.b_px < kMaxNoise_px && support_.squared_gradient < limit * limit;
  }

  // A dot of a few pixels may be cut by something as bright as its surroundings: blur rounds what is left. What shows
  // it is scatter beyond the noise and a step that changes along the contour; below the blur's width nothing does.
  void widen_dot(double rms_px) {
    // Whole dots scatter by at most 0.035 px beyond noise, seven of ten; their squared gradients by less than 0.15 of
    // the mean. The factors: what cut dots of simulated images are off by.
    constexpr double kWholeScatter_px = 0.035, kPerScatter = 5.0, kWholeVariation = 0.15, kVariation_px = 1.5,
                     kPerGap = 2.0;
    constexpr double kResolved_px = 4.0, kPerUnresolved = 0.12, kUnresolved_px = 2.5, kOfUnresolved = 0.25;
    // Of b: what blur leaves of a triangle's or square's corners.
    constexpr double kOfCorners = 0.025;
    const double b_px = fit_.ellipse.b_px;
    if (b_px >= kMaxDot_px) return;
    const double noise_px = kNoiseToEdge_px * noise_ / std::sqrt(support_.squared_gradient);
    const double scatter_px = std::sqrt(std::max(0.0, rms_px * rms_px - 0.5 * noise_px * noise_px));
    const double hidden_px =
        kPerGap * std::max(0.0, support_.inside_fraction - support_.length_fraction) * fit_.ellipse.a_px;
    const double cut_px = hidden_px + kPerScatter * std::max(0.0, scatter_px - kWholeScatter_px) +
                          kVariation_px * std::max(0.0, support_.gradient_variation - kWholeVariation);
    double shape_px = std::hypot(cut_px, kPerUnresolved * std::max(0.0, kResolved_px - b_px));
    const bool has_corners = b_px < kResolved_px && scatter_px > kOfCorners * b_px;
    if (b_px < kUnresolved_px || has_corners) shape_px = std::max(shape_px, kOfUnresolved * fit_.ellipse.a_px);
    fit_.covariance.diagonal().head<4>().array() += 0.5 * shape_px * shape_px;
  }

  // Fits the points for which `keep(number)` is true.
  template <class Keep>
  std::optional<RefinedFit> fit_of(std::size_t min_points, Keep&& keep) const {
    Points points;
    for (std::size_t k = 0; k < support_.points.size(); ++k) {
      if (keep(k)) points.push_back(support_.points[k]);
    }
    if (points.size() < min_points) return std::nullopt;
    const std::optional<RefinedFit> fit =
        refine_fit(fit_.ellipse, std::span<const PointF>(points.data(), points.size()), support_.independent());
    return fit && is_plausible(fit->ellipse, settings_) ? fit : std::nullopt;
  }

  Vector5 change_to(const Ellipse& other) const {
    const Ellipse& e = fit_.ellipse;
    Vector5 change;
    change << other.cx_px - e.cx_px, other.cy_px - e.cy_px, other.a_px - e.a_px, other.b_px - e.b_px,
        std::remainder(other.theta_rad - e.theta_rad, std::numbers::pi);
    return change;
  }

  // Takes another fit instead, and half of what it changes as an error of it.
  void take(const RefinedFit& other) {
    const Vector5 change = change_to(other.ellipse);
    fit_ = other;
    add_half_of(change);
  }
  void add_half_of(const Vector5& change) {
    fit_.covariance += 0.25 * change * change.transpose();
    limit_direction(fit_.covariance);
  }

  RefinedFit fit_;
  const Support& support_;
  const EllipseSettings& settings_;
  double noise_;
};

}  // namespace

bool is_plausible(const Ellipse& e, const EllipseSettings& settings, double of_min_minor) {
  return e.b_px >= of_min_minor * settings.min_minor_px && e.a_px < settings.max_axis_ratio * e.b_px &&
         e.a_px < kMaxSide_px;
}

std::optional<RefinedFit> checked_fit(const RefinedFit& fit, const Support& support, const EllipseSettings& settings,
                                      const EllipseWorkspace& workspace) {
  return FitCheck(fit, support, settings, workspace).run();
}

}  // namespace pharos::ellipse
