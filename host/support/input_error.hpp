// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace pharos::host {

/// Invalid input or usage. The message is one line for the user: what, where (file, line, key), what
/// to do. Programs print it on standard error and exit with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pharos::host
