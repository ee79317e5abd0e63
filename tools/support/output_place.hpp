// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace pharos::tools {

inline constexpr const char* kOutputPlace = "output place";

/// For ->check(): marks an option whose value is a file or folder that the command writes. The command line refuses to
/// write onto anything that another option names (refuse_output_onto_input).
inline CLI::Validator output_place() {
  return {[](std::string&) { return std::string(); }, "", kOutputPlace};
}

/// Throws host::InputError where a marked option of `command` names the same file or folder as another option does.
void refuse_output_onto_input(const CLI::App& command);

}  // namespace pharos::tools
