// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tools/evaluation/report/exhibits.hpp"
#include "tools/evaluation/report/store.hpp"

namespace pharos::tools::report {

struct ReportContent {
  std::string commit;
  PartSettings settings;
  std::map<std::string, FinishedPart> parts;  ///< by id
  std::vector<std::string> problems;          ///< what a table or figure should have and has not
};

bool all_parts_there(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts);
/// What the exhibit's parts found, of those that were run.
PartResult result_of(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts);

/// One page with all tables and pictures in it: no script, nothing from the network. `folder` holds the parts' folders.
std::string html_of(const ReportContent& content, const std::filesystem::path& folder);

/// The tables alone, as Markdown.
std::string markdown_of(const ReportContent& content);

}  // namespace pharos::tools::report
