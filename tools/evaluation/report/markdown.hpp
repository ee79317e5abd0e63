// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluation/report/content.hpp"

namespace pharos::tools::report {

/// The tables alone, as Markdown; its uppermost heading is of `level`, 1 to 4.
std::string markdown_of(const ReportContent& content, int level);

}  // namespace pharos::tools::report
