// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/manual/description.hpp"

namespace pharos::tools {

/// What a page says besides its command's own definition.
struct PageFrame {
  int section = 1;
  std::string version;                // in the page's foot, "0.2.0"
  std::string exit_status;            // a paragraph; empty: none
  std::vector<std::string> see_also;  // other pages, "pharosd(8)"
};

/// The manual page of `command` alone, in the language of man(7): name, synopsis, arguments, options with their limits
/// and defaults, subcommands by name, the footer as notes and examples.
std::string man_page(const CommandDescription& command, const PageFrame& frame);

/// `text` with whatever roff would interpret protected; hyphens stay ASCII, so that examples can be copied. A line may
/// be broken after a comma.
std::string roff_text(const std::string& text);

}  // namespace pharos::tools
