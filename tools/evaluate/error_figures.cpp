// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/error_figures.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::evaluate {
namespace {

double squared(double x) { return x * x; }

/// One half of the errors.
struct Half {
  std::vector<Vector3> errors;
  std::vector<double> sigmas;  // as many as errors, or fewer where some are not stated
};

std::vector<double> norms_of(const std::vector<Vector3>& errors) {
  std::vector<double> norms;
  norms.reserve(errors.size());
  for (const Vector3& e : errors) norms.push_back(e.norm());
  return norms;
}

double spread_of(const std::vector<Vector3>& errors) {
  const double n = static_cast<double>(errors.size());
  Vector3 mean = Vector3::Zero();
  for (const Vector3& e : errors) mean += e / n;
  double sum = 0.0;
  for (const Vector3& e : errors) sum += (e - mean).squaredNorm();
  return std::sqrt(sum / n);
}

std::optional<Consistency> consistency_of(const Half& half) {
  if (half.sigmas.size() != half.errors.size()) return std::nullopt;
  const auto exact = std::count(half.sigmas.begin(), half.sigmas.end(), 0.0);
  const auto judged = static_cast<std::ptrdiff_t>(half.sigmas.size()) - exact;
  if (judged == 0) return std::nullopt;
  Consistency consistency;
  const double each = 1.0 / static_cast<double>(judged);
  for (std::size_t i = 0; i < half.errors.size(); ++i) {
    if (half.sigmas[i] == 0.0) continue;  // exact by definition, as slam's first pose
    const double ratio = half.errors[i].norm() / half.sigmas[i];
    consistency.normalised_square += each * squared(ratio);
    for (std::size_t k = 0; k < consistency.within.size(); ++k) {
      if (ratio <= static_cast<double>(k + 1)) consistency.within[k] += each;
    }
  }
  return consistency;
}

Figures figures_of_half(const Half& half) {
  Figures figures;
  figures.error = distribution_of(norms_of(half.errors));
  figures.spread = spread_of(half.errors);
  figures.consistency = consistency_of(half);
  return figures;
}

struct Relative {
  std::vector<double> rotation_rad;
  std::vector<double> position_m;
};

/// Errors of (P_i^-1 P_j)^-1 (E_i^-1 E_j), j the first pose at least `relative_s` after i, if it is not later by more
/// than the gap allowed.
Relative relative_errors(const std::vector<Pair>& pairs, const Alignment& alignment, double relative_s,
                         double max_gap_s) {
  Relative errors;
  std::size_t j = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double wanted_s = pairs[i].estimate.time_s + relative_s * (1.0 - 1e-9);
    while (j < pairs.size() && pairs[j].estimate.time_s < wanted_s) ++j;
    if (j == pairs.size()) break;
    if (pairs[j].estimate.time_s > wanted_s + max_gap_s) continue;
    const auto estimated = pairs[i].estimate.pose.inverse() * pairs[j].estimate.pose;
    const auto true_motion =
        alignment.predicted(pairs[i].truth.pose).inverse() * alignment.predicted(pairs[j].truth.pose);
    const auto error = true_motion.inverse() * estimated;
    errors.rotation_rad.push_back(rotation_log(error.R).norm());
    errors.position_m.push_back(error.t.norm());
  }
  return errors;
}

double ate_of(const std::vector<Pair>& pairs, const Alignment& alignment) {
  Alignment fitted = alignment;
  fitted.world = se3_of_positions(pairs, alignment).world;
  double sum = 0.0;
  for (const Pair& p : pairs) sum += (p.estimate.pose.t - fitted.predicted(p.truth.pose).t).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

double coverage_of(const std::vector<Pair>& pairs, CommonSpan span, double max_gap_s) {
  const double length_s = span.end_s - span.begin_s;
  if (!(length_s > 0.0)) return 1.0;  // a single instant, which was compared
  double covered_s = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double step_s = pairs[i].estimate.time_s - pairs[i - 1].estimate.time_s;
    if (step_s <= max_gap_s) covered_s += step_s;
  }
  return std::min(1.0, covered_s / length_s);
}

}  // namespace

std::vector<PoseError> errors_of(const std::vector<Pair>& pairs, const Alignment& alignment) {
  std::vector<PoseError> errors;
  errors.reserve(pairs.size());
  for (const Pair& p : pairs) {
    const Vector6 e = pose_difference(p.estimate.pose, alignment.predicted(p.truth.pose));
    errors.push_back(
        {p.estimate.time_s, e.head<3>(), e.tail<3>(), p.estimate.sigma_rotation_rad, p.estimate.sigma_position_m});
  }
  return errors;
}

Distribution distribution_of(std::vector<double> norms) {
  std::sort(norms.begin(), norms.end());
  double sum = 0.0;
  for (const double norm : norms) sum += squared(norm);
  // The smallest value that the fraction does not exceed.
  const auto quantile = [&norms](double fraction) {
    const double rank = std::ceil(fraction * static_cast<double>(norms.size()));
    return norms[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  return {std::sqrt(sum / static_cast<double>(norms.size())), quantile(0.5), quantile(0.95), quantile(0.99),
          norms.back()};
}

AllFigures figures_of(const std::vector<Pair>& pairs, const Alignment& alignment, CommonSpan span, double relative_s,
                      double max_gap_s) {
  Half rotation;
  Half position;
  for (const PoseError& e : errors_of(pairs, alignment)) {
    rotation.errors.push_back(e.rotation_rad);
    position.errors.push_back(e.position_m);
    if (e.sigma_rotation_rad) rotation.sigmas.push_back(*e.sigma_rotation_rad);
    if (e.sigma_position_m) position.sigmas.push_back(*e.sigma_position_m);
  }
  AllFigures all{figures_of_half(rotation), figures_of_half(position), ate_of(pairs, alignment), 0,
                 coverage_of(pairs, span, max_gap_s)};
  Relative relative = relative_errors(pairs, alignment, relative_s, max_gap_s);
  all.relative_pairs = relative.rotation_rad.size();
  if (all.relative_pairs > 0) {
    all.rotation.relative = distribution_of(std::move(relative.rotation_rad)).rms;
    all.position.relative = distribution_of(std::move(relative.position_m)).rms;
  }
  return all;
}

}  // namespace pharos::evaluate
