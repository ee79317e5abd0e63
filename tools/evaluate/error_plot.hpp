// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluate/error_figures.hpp"

namespace pharos::evaluate {

/// Draws both errors over time (one panel each) with their RMS and, where stated, three sigma. At most 2000 points a
/// curve: the maximum of each interval, so that no peak is lost; curves break at gaps. Throws host::InputError when the
/// file cannot be written.
void plot_errors(const std::string& path, const std::vector<PoseError>& errors, const AllFigures& figures,
                 double max_gap_s);

}  // namespace pharos::evaluate
