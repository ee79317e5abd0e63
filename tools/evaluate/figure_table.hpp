// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluate/comparison.hpp"

namespace pharos::evaluate {

/// How many of ESTIMATE's rows became what.
struct RowCounts {
  std::size_t rows = 0, compared = 0, refused = 0, ambiguous = 0, flagged = 0, outside = 0, in_gap = 0;
};

/// The row of figures as a table for people: a line a figure, rotation beside position. Where there is no result only
/// the counts and why.
std::string figure_table(const Comparison& comparison, const RowCounts& counts, double relative_s);

}  // namespace pharos::evaluate
