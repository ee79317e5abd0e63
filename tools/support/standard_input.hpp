// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/support/input_error.hpp"

namespace pharos::tools {

/// An input of a command and its argument.
struct NamedInput {
  const char* name;  // "EDGES", "--target"
  const std::string& path;
};

/// Throws InputError where more than one input is `-`: standard input can be read once.
inline void require_one_standard_input(const std::vector<NamedInput>& inputs) {
  const NamedInput* first = nullptr;
  for (const NamedInput& input : inputs) {
    if (input.path != "-") continue;
    if (first != nullptr) {
      throw host::InputError(std::string(first->name) + " and " + input.name +
                             " cannot both be standard input (-); give a file for one");
    }
    first = &input;
  }
}

}  // namespace pharos::tools
