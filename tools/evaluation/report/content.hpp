// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/evaluation/report/exhibits.hpp"
#include "tools/evaluation/report/store.hpp"

namespace pharos::tools::report {

/// What the page and the Markdown are made of.
struct ReportContent {
  std::string commit;
  std::uint64_t seed = 1;
  std::map<std::string, FinishedPart> parts;  ///< by id
  std::vector<std::string> problems;          ///< what a table or figure should have and has not
};

bool all_parts_there(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts);
/// What the exhibit's parts found, of those that were run.
PartResult result_of(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts);

/// The exhibit's rows, in the order of its parts.
std::vector<ComparisonRow> rows_of(const Exhibit& exhibit, const ReportContent& content);
/// Rows of a paper's parts that are of no numbered table or figure: text, and what the paper leaves out.
std::vector<ComparisonRow> further_rows_of(const Paper& paper, const ReportContent& content);

/// "Table 1: what it shows".
std::string heading_of(const Exhibit& exhibit);
/// The part, whether it was quick, and the time that it took.
std::string made_by(std::string_view id, const FinishedPart& part);
/// Commit and seed.
std::string origin_of(const ReportContent& content);

/// As rounded_as does, or nothing.
std::string shown(const std::optional<double>& value, const std::string& published);

}  // namespace pharos::tools::report
