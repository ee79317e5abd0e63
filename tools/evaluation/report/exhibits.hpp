// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools::report {

/// A numbered table or figure of one of the five papers, and what the report has for it.
struct Exhibit {
  std::string_view paper;               ///< "000" to "004"
  std::string_view label;               ///< "table 2", "figure 8"
  std::string_view caption;             ///< in English
  std::vector<std::string_view> parts;  ///< that compute it; empty: it has none, and `remark` says why
  std::string_view remark;              ///< what differs from the paper and why; or why there is nothing to compute
  bool picture = false;                 ///< it must come with a picture
  /// Rows that must be there, one for each printed figure: each text is found in "ITEM: WHAT" of at least one row.
  std::vector<std::string> rows = {};
  /// Pictures that must be there: each text is found in "LABEL: CAPTION" of at least one.
  std::vector<std::string> pictures = {};
};

struct Paper {
  std::string_view number;
  std::string_view title;
  std::string_view subject;  ///< Pharos' word: lighthouse, tof, ring2, line, slam
};

const std::vector<Paper>& papers();
/// Every numbered table and figure, in the order of the papers.
const std::vector<Exhibit>& exhibits();

/// The row is of this table or figure: "figure 8a" is of figure 8, "figure 10" not of figure 1.
bool is_of(const Exhibit& exhibit, std::string_view item);

/// What the exhibit should have and `result` has not, one sentence each. A row without figures must have a remark.
std::vector<std::string> missing_of(const Exhibit& exhibit, const PartResult& result);

}  // namespace pharos::tools::report
