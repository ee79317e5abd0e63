// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools::report {

struct ReportOptions {
  std::string folder;
  PartSettings settings;
  std::vector<std::string> only;   ///< ids of parts; empty: all
  std::vector<std::string> quick;  ///< ids of parts that are quick where settings.quick is not set
  std::string results;             ///< a Markdown file whose section takes the tables too (put_section); empty: none
};

/// Runs the parts one after the other, or takes what a former run with the same program and settings kept in the
/// folder; writes report.html and report.md after each, so that an interrupted run leaves what it has. True where every
/// table and figure of the parts that were asked for has what exhibits() says.
bool run_report(const std::vector<Part>& parts, const ReportOptions& options);

}  // namespace pharos::tools::report
