// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace pharos::tools {

/// One file of the page, as it was when the program was built.
struct PageFile {
  std::string_view path;  // of its URL
  std::string_view type;
  std::string_view bytes;
};

/// The page's file at `path`, compared whole; null where there is none.
const PageFile* find_page_file(std::string_view path);

}  // namespace pharos::tools
