// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "pharos/ring2/circle_model.hpp"

namespace pharos::ring2 {

/// The fit's input: the rig, up to four contours by [view][circle], and which unknowns they determine.
struct CircleProblem {
  Rig rig;
  std::array<std::array<std::optional<Contour>, 2>, kViews> contours;
  std::array<bool, kUnknowns> free{};

  int ellipses() const;
  int degrees_of_freedom() const;  ///< observations beyond unknowns
};

/// Sums of all contours at a model; unknowns that are not free have the unit matrix and no gradient. Empty where a
/// circle cannot be seen by a camera that saw it.
std::optional<NormalEquations> linearise(const CircleProblem& problem, const CircleModel& model);

struct RefinedCircles {
  CircleModel model;
  NormalEquations sums;  ///< at the model
  int iterations = 0;
};

/// Descent to the nearest minimum, to a thousandth of a standard deviation and one step beyond. Empty where the
/// unknowns are not determined, or where a step shows that chi2 will stay above `abandon_chi2`.
std::optional<RefinedCircles> refine(const CircleProblem& problem, const CircleModel& start, double abandon_chi2);

}  // namespace pharos::ring2
