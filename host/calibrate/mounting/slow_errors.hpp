// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/calibrate/mounting/mounting_adjustment.hpp"

namespace pharos::calibrate {

/// The input with each source's slow error as the recording tells it: the variance under which the rows are most
/// likely, by the fixed point sum of squares over well-determined freedoms (MacKay, "Bayesian interpolation", Neural
/// Computation 4 (1992), equation 4.9), from the input's assumption on. A mounting takes up the mean of its source's
/// slow error, so that of a minute only the changes tell. A source of which the rows tell nothing keeps what was
/// assumed.
///
/// `rows`, `enlarged`: those of the adjustment that found `unknowns`. Cost: an evaluation of the problem and a
/// factorisation for each of six steps.
MountingCalibrationInput with_estimated_slow_errors(const MountingCalibrationInput& input,
                                                    const std::vector<UsedRow>& rows,
                                                    const std::vector<double>& enlarged,
                                                    const MountingUnknowns& unknowns);

struct SourceErrors {
  double noise_time_s = 0.0;  // noise_time.hpp
  std::optional<host::SlowError> slow;
};

/// Each source's slow error of `estimated` as a ratio to the noise that it states. The time constant is the input's: a
/// minute does not tell one of half a minute. Of slam none: its error is a random walk.
///
/// Never below what the noise of one time constant's poses leaves of its mean: a smaller slow error looks like noise.
///
/// Of the given source, whose mounting takes nothing up: not below what it states and its residuals do not show. Errors
/// that all of its poses have in common (sensors' places, a rotor's calibration) move the motion and leave no residual.
/// So does noise that moves slowly: where it is found it explains all of it but the scatter of its own mean square.
///
/// `fits`: residuals of the adjustment that found `unknowns`.
std::vector<SourceErrors> source_errors(const MountingCalibrationInput& estimated, const std::vector<UsedRow>& rows,
                                        const MountingUnknowns& unknowns, const std::vector<MountingFit>& fits);

}  // namespace pharos::calibrate
