// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluate/comparison.hpp"
#include "tools/evaluate/trajectory_file.hpp"
#include "tools/plot_pages/html_page.hpp"

namespace pharos::tools {

/// Path in three projections, position and rotation vector over time with three sigma, and what is not shown.
/// Precondition: at least one pose.
void add_trajectory(HtmlPage& page, const std::string& name,
                    const evaluate::TrajectoryFile<evaluate::EstimatePose>& poses);

/// Errors of a comparison that has a result, by axis with three sigma, and their figures.
void add_errors(HtmlPage& page, const evaluate::Comparison& comparison);

}  // namespace pharos::tools
