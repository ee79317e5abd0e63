// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/calibrate/mounting/mounting_calibration.hpp"

namespace pharos::calibrate {

/// For how long the noise of a source's poses is alike, s, from what the adjustment left; 0: each pose has its own, or
/// the source is too slow to tell. A source that filters, as the motion tracker of the lighthouse does, has an error
/// that moves over some tenths of a second.
///
/// Model: the stated variance is that of white noise and of a first-order Gauss-Markov error of time T and fraction v.
/// Differences of residuals l apart have the variance 2 (1 - v exp(-l / T)) of it, which the spline of the motion, a
/// knot every `knot_s`, hardly changes where l is a small part of a knot: differences at l and 2 l give v and T. The
/// answer is v T, the time of noise that is Gauss-Markov as a whole and averages out as slowly: of rotation or of
/// position, the shorter. A filter's memory is one, and a part whose sigma is stated too wide seems to last longer.
/// What is alike for longer than two knots is no noise here but a slow error. An error that all poses have in common
/// beside the noise looks like a longer time: with half of the variance in common 0.1 s becomes 0.27 s.
double noise_time_s(const MountingFit& fit, double knot_s);

}  // namespace pharos::calibrate
