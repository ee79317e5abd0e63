// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace pharos::tools {

/// Adds `--scene tumbling`, `boards`, `room`, `street` and their options to `pharos sim stereo`. The function that
/// comes back writes that scene into `directory` and says true; without --scene it does nothing and says false.
std::function<bool(std::uint64_t seed, const std::string& directory)> add_tumbling_options(CLI::App& command);

}  // namespace pharos::tools
