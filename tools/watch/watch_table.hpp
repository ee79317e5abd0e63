// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/sources/source_table.hpp"

namespace pharos::tools {

/// What `pharos watch` shows: a row a source, the daemons' states, the newest events last, as lines of at most
/// `columns` characters.
std::vector<std::string> watch_lines(const SourceTable& table, std::int64_t now_ns, std::size_t columns);

}  // namespace pharos::tools
