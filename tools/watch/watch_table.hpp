// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/sources/source_table.hpp"

namespace pharos::tools {

/// `text` for a terminal, at most `size` characters: whoever can send a message must not send escape sequences.
std::string printable(std::string_view text, std::size_t size);

/// What `pharos watch` shows: a row a source, the daemons' states, the newest events last, as lines of at most
/// `columns` characters.
std::vector<std::string> watch_lines(const SourceTable& table, std::int64_t now_ns, std::size_t columns);

}  // namespace pharos::tools
