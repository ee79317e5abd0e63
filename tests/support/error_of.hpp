// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

namespace pharos::test {

/// The message of the exception thrown by `action`; empty where it throws none.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace pharos::test
