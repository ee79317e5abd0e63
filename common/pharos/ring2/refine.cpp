// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/refine.hpp"

#include <algorithm>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::ring2 {
namespace {

constexpr int kMaxIterations = 30;
constexpr int kMaxTrials = 8;  // of damping, for one step
constexpr int kAbandonAfterSteps =
    2;                               // steps: from a start within the noise of a minimum, Gauss-Newton is there by then
constexpr double kConverged = 1e-6;  // squared step in standard deviations: what is left is a millionth of one

bool is_sound(const CircleModel& model) {
  return model.normal.allFinite() && model.centre_m.allFinite() && model.radius_m > 0.0 &&
         model.second_radius_m >= 0.0 && std::isfinite(model.radius_m) && std::isfinite(model.distance_m) &&
         std::isfinite(model.second_radius_m);
}

std::optional<Vector8> damped_step(const NormalEquations& sums, double damping) {
  Matrix8 matrix = sums.matrix;
  for (int i = 0; i < kUnknowns; ++i) matrix(i, i) *= 1.0 + damping;
  const auto inverse = positive_inverse<kUnknowns>(matrix);
  if (!inverse) return std::nullopt;
  Vector8 step = Vector8::Zero();
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j < kUnknowns; ++j) step[i] -= (*inverse)(i, j) * sums.gradient[j];
  }
  return step;
}

double squared_deviations(const NormalEquations& sums, const Vector8& step) {
  double sum = 0.0;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j < kUnknowns; ++j) sum += step[i] * sums.matrix(i, j) * step[j];
  }
  return sum;
}

}  // namespace

int CircleProblem::ellipses() const {
  int count = 0;
  for (const auto& view : contours) {
    for (const auto& contour : view) count += contour.has_value() ? 1 : 0;
  }
  return count;
}

int CircleProblem::degrees_of_freedom() const {
  return 5 * ellipses() - static_cast<int>(std::count(free.begin(), free.end(), true));
}

std::optional<NormalEquations> linearise(const CircleProblem& problem, const CircleModel& model) {
  NormalEquations sums;
  for (std::size_t v = 0; v < kViews; ++v) {
    for (std::size_t c = 0; c < 2; ++c) {
      const std::optional<Contour>& contour = problem.contours[v][c];
      const Circle circle = c == 0 ? Circle::kFirst : Circle::kSecond;
      if (contour && !add_ellipse(model, circle, problem.rig.views[v], *contour, sums)) return std::nullopt;
    }
  }
  for (int i = 0; i < kUnknowns; ++i) {
    if (problem.free[static_cast<std::size_t>(i)]) continue;
    for (int j = 0; j < kUnknowns; ++j) sums.matrix(i, j) = sums.matrix(j, i) = i == j ? 1.0 : 0.0;
    sums.gradient[i] = 0.0;
  }
  return sums;
}

std::optional<RefinedCircles> refine(const CircleProblem& problem, const CircleModel& start, double abandon_chi2) {
  const std::optional<NormalEquations> first = linearise(problem, start);
  if (!first) return std::nullopt;
  RefinedCircles now{start, *first, 0};
  double damping = 0.0;
  for (int trials = 0; now.iterations < kMaxIterations && trials < kMaxTrials;) {
    const std::optional<Vector8> step = damped_step(now.sums, damping);
    if (!step) return std::nullopt;
    const CircleModel next = moved(now.model, *step);
    const std::optional<NormalEquations> sums =
        is_sound(next) ? linearise(problem, next) : std::optional<NormalEquations>{};
    // So near the minimum chi2 no longer tells better from worse: the step is the last, whatever it says.
    const bool done = damping == 0.0 && squared_deviations(now.sums, *step) < kConverged;
    if (!sums || (!done && !(sums->chi2 <= now.sums.chi2))) {
      damping = std::max(1e-3, 10.0 * damping);
      ++trials;
      continue;
    }
    now = {next, *sums, now.iterations + 1};
    if (done) break;
    damping = damping < 1e-2 ? 0.0 : 0.1 * damping;
    trials = 0;
    if (now.iterations == kAbandonAfterSteps && now.sums.chi2 > abandon_chi2) return std::nullopt;
  }
  return now;
}

}  // namespace pharos::ring2
