// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace pharos::host {

/// Input or usage that cannot be worked with. The message is one line for a person: what, where (file, line, key), what
/// to do. Programs print it on standard error and exit with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pharos::host
