// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "tools/evaluation/report/content.hpp"

namespace pharos::tools::report {

/// One page with all tables and pictures in it: no script, nothing from the network. `folder` holds the parts' folders.
std::string html_of(const ReportContent& content, const std::filesystem::path& folder);

}  // namespace pharos::tools::report
