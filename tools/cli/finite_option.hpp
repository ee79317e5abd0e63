// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace pharos::tools {

/// For ->check() beside a range: CLI11's ranges let nan through, since it is neither below nor above anything.
inline CLI::Validator finite_number() {
  return {[](std::string& text) {
            return std::isfinite(std::strtod(text.c_str(), nullptr)) ? std::string() : text + " is not a finite number";
          },
          "", "finite"};
}

}  // namespace pharos::tools
