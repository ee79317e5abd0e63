// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/ellipse/refine_fit.hpp"
#include "pharos/ellipse/settings.hpp"
#include "pharos/ellipse/support.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// An arc that turns by less is not fitted alone: the fit would follow the noise.
inline constexpr float kMinTurnAlone_rad = 1.75F;

/// Whether the settings allow an ellipse of this size and shape; `of_min_minor`: fraction of the minimum semi-minor
/// axis that is enough.
bool is_plausible(const Ellipse& e, const EllipseSettings& settings, double of_min_minor = 1.0);

/// The fit without the points that something else may bend, and with a covariance that holds what bent it. Empty where
/// the fit is no ellipse's: too rough, not determined by what is seen of it, or noise.
///
/// `support`: the points of the fit, collected about it. `rms_px` stays that of all of them.
std::optional<RefinedFit> checked_fit(const RefinedFit& fit, const Support& support, const EllipseSettings& settings,
                                      const EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
