// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools::report {

/// A finished part as it is kept in the report's folder.
struct FinishedPart {
  std::string key;  ///< of what it was made: program, settings
  std::string command;
  bool quick = false;
  double seconds = 0.0;
  PartResult result;
};

/// Settings and the running program's bytes in one word: the same key, the same result.
std::string key_of(const std::string& part, const PartSettings& settings);

/// Writes `part.json` into `folder`, as the last of the part's files: a part that was interrupted has none. Throws
/// host::InputError.
void keep(const FinishedPart& part, const std::filesystem::path& folder);

/// The part in `folder` where it is complete, was made with `key` and its pictures are there; else nothing.
std::optional<FinishedPart> kept_part(const std::filesystem::path& folder, const std::string& key);

}  // namespace pharos::tools::report
