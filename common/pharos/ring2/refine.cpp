// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/refine.hpp"

#include <algorithm>
#include <limits>

#include "pharos/optimize/descent.hpp"

namespace pharos::ring2 {
namespace {

constexpr int kMaxIterations = 30;
// Of chi2, by which a last step may still lower it: the squared step in standard deviations.
constexpr double kConverged = 1e-6;

bool is_sound(const CircleModel& model) {
  return model.normal.allFinite() && model.centre_m.allFinite() && model.radius_m > 0.0 &&
         model.second_radius_m >= 0.0 && std::isfinite(model.radius_m) && std::isfinite(model.distance_m) &&
         std::isfinite(model.second_radius_m);
}

struct CircleDescent : optimize::LeastSquares<kUnknowns, CircleModel, NormalEquations> {
  static constexpr bool kEndsWhereSingular = true;  // the unknowns are not determined
  static constexpr bool kSumsAtEnd = true;

  explicit CircleDescent(const CircleProblem& p) : problem(p) {}

  NormalEquations linearise(const CircleModel& model) const {
    if (is_sound(model)) {
      if (const std::optional<NormalEquations> sums = ring2::linearise(problem, model)) return *sums;
    }
    NormalEquations none;
    none.cost = std::numeric_limits<double>::infinity();
    return none;
  }
  CircleModel moved(const CircleModel& model, const Vector8& delta) const { return ring2::moved(model, delta); }

  const CircleProblem& problem;
};

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
  optimize::Descent<CircleDescent> d;
  optimize::descend(CircleDescent(problem), start, {kMaxIterations, kConverged, abandon_chi2}, d);
  switch (d.ending) {
    case optimize::Ending::kBadStart:
    case optimize::Ending::kSingular:
    case optimize::Ending::kHopeless:
      return std::nullopt;
    default:  // the best found: flat minima of circles that face the cameras end without converging
      return RefinedCircles{d.state, d.normal, d.iterations};
  }
}

}  // namespace pharos::ring2
