// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pharos::tools::report {

/// The lines of a Markdown file between which a report's tables stand.
inline constexpr std::string_view kSectionBegin = "<!-- five papers: begin -->";
inline constexpr std::string_view kSectionEnd = "<!-- five papers: end -->";

/// Throws host::InputError where `path` cannot be read or written, or does not have each of the two lines once, in this
/// order.
void require_section(const std::string& path);
/// Replaces what is between the two lines; the rest of the file remains byte by byte. Throws as require_section.
void put_section(const std::string& path, std::string_view text);

}  // namespace pharos::tools::report
